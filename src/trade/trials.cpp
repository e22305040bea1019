#include "trade/trials.h"

#include <algorithm>

#include "cli/batch.h"
#include "cli/option_table.h"
#include "measure/work.h"

namespace rsphere {

// Settings that differ in sphere mode's own options share one: it holds the tree of all surfaces.
const Transport& Trials::transportOf(const Options& options) {
  Options key = options;
  key.sphere = SphereOptions{};
  key.sphere.basicRadiance = options.sphere.basicRadiance;
  auto& transport = transports_[defaultsText(key)];
  if (!transport)
    transport =
        std::make_unique<Transport>(scene_, options.ray, Irradiance::none, options.sphere.basicRadiance);
  return *transport;
}

bool Trials::run(const Options& options, bool standardErrors, bool timed, Trial& trial) {
  const Transport& transport = transportOf(options);
  const double begin = threadSeconds();
  const SphereEstimator estimator(transport, options.sphere, standardErrors);
  const double setup = threadSeconds() - begin;
  std::vector<SphereEstimator::Workspace> workspaces;
  for (unsigned k = 0; k < threadCount(options); ++k) workspaces.emplace_back(estimator);
  const size_t count = points_.size() / 3;
  std::vector<PointAnswer> answers(count);
  std::vector<double> seconds(count);
  const bool whole = forEachIndex(count, options, &signals_, [&](size_t i, unsigned worker) {
    const double start = threadSeconds();
    answers[i] =
        estimator.estimate(V3d(points_[3 * i], points_[3 * i + 1], points_[3 * i + 2]), workspaces[worker]);
    seconds[i] = threadSeconds() - start;
  });
  if (!whole) return false;
  trial.answers.points = count;
  for (size_t i = 0; i < count; ++i) {
    trial.answers.values.push_back(brightness(answers[i].mean));
    if (standardErrors) trial.estimates.push_back(brightness(answers[i].standardError));
    if (!timed) continue;
    trial.seconds += seconds[i];
    trial.directions += static_cast<double>(answers[i].directions);
  }
  if (timed) trial.setupSeconds = std::max(trial.setupSeconds, setup);
  return true;
}

}  // namespace rsphere
