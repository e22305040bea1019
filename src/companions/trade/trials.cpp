#include "companions/trade/trials.h"

#include <algorithm>

#include "base/colorimetry.h"
#include "companions/measure/work.h"

namespace rsphere {

// A Transport contains Embree's tree of all surfaces, which is large. Settings share it if possible.
const Transport& Trials::transportOf(const Setting& setting) {
  auto& transport = transports_[setting.rays];
  if (!transport)
    transport = std::make_unique<Transport>(scene_, setting.options.ray, IrradianceAt::none,
                                            setting.options.sphere.basicRadiance);
  return *transport;
}

bool Trials::run(const Setting& setting, bool standardErrors, bool timed, Trial& trial,
                 const std::function<void()>& pointAnswered) {
  const AnswerOptions& options = setting.options;
  const Transport& transport = transportOf(setting);
  const double begin = threadSeconds();
  PointWorkers workers(transport, options, standardErrors, [this] { signals_.check(); });
  const double setup = threadSeconds() - begin;
  const size_t count = points_.size() / 3;
  std::vector<PointAnswer> answers(count);
  std::vector<double> seconds(count);
  const auto answer = [&](size_t i, unsigned worker) {
    const double start = threadSeconds();
    answers[i] = workers.answer(V3d(points_[3 * i], points_[3 * i + 1], points_[3 * i + 2]), worker);
    seconds[i] = threadSeconds() - start;
    if (pointAnswered) pointAnswered();
  };
  if (!forEachIndex(count, options.threads, &signals_, answer, leave_)) return false;
  trial.answers.points = count;
  for (size_t i = 0; i < count; ++i) {
    trial.answers.values.push_back(photopicOf(answers[i].mean.color, options.ray.sampling));
    if (standardErrors) trial.estimates.push_back(answers[i].brightnessError);
    if (!timed) continue;
    const auto n = static_cast<double>(++trial.timed);
    trial.seconds += (seconds[i] - trial.seconds) / n;
    trial.directions += (static_cast<double>(answers[i].directions) - trial.directions) / n;
  }
  if (timed) trial.setupSeconds = std::max(trial.setupSeconds, setup);
  return true;
}

}  // namespace rsphere
