#include "companions/trade/trials.h"

#include <algorithm>
#include <optional>

#include "answer/answer_rays.h"
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

Trials::Answerer Trials::points(const Setting& setting, bool standardErrors) {
  const AnswerOptions& options = setting.options;
  const auto workers = std::make_shared<PointWorkers>(transportOf(setting), options, standardErrors);
  return [this, workers, &options](size_t i, unsigned worker) {
    const PointAnswer a =
        workers->answer(V3d(points_[3 * i], points_[3 * i + 1], points_[3 * i + 2]), worker);
    return Answer{photopicOf(a.mean.color, options.ray.sampling), a.brightnessError, a.directions};
  };
}

// Each repeat has patches of its own, whose noise all rays share.
Trials::Answerer Trials::rays(const Setting& setting) {
  struct Workers {
    Workers(const Scene& scene, const AnswerOptions& options)
        : transport(scene, options.ray, options.irradiance) {}
    Transport transport;
    std::vector<PathTracer> tracers{};
    std::optional<EstimatedRays> estimated{};
  };
  const AnswerOptions& options = setting.options;
  const auto workers = std::make_shared<Workers>(scene_, options);
  if (options.sphere.accuracy > 0)
    workers->estimated.emplace(workers->transport, options);
  else
    workers->tracers = rayTracers(workers->transport, options);
  return [this, workers, &options](size_t i, unsigned worker) {
    const std::span<const double> numbers = points_.subspan(perRecord_ * i, perRecord_);
    const InputRay in = inputRay(numbers.data(), options.irradiance, scene_.samePlace);
    const uint64_t seed = seedOfRay(numbers, i, options);
    const auto brightnessOf = [&](const Radiance& value) {
      return photopicOf(value.color, options.ray.sampling);
    };
    if (!workers->estimated)
      return Answer{brightnessOf(workers->tracers[worker].trace(in.origin, in.direction, 0, seed).value)};
    const RayEstimator::Estimate estimate = workers->estimated->estimate(worker, in, 0, seed);
    return Answer{brightnessOf(estimate.ray.value), estimate.brightnessError};
  };
}

bool Trials::run(const Setting& setting, bool standardErrors, bool timed, Trial& trial,
                 const std::function<void()>& pointAnswered) {
  const AnswerOptions& options = setting.options;
  if (options.sphereMode) transportOf(setting);  // shared, so that its time does not count
  const double begin = threadSeconds();
  const Answerer workers = options.sphereMode ? points(setting, standardErrors) : rays(setting);
  const double setup = threadSeconds() - begin;
  const size_t count = points();
  std::vector<Answer> answers(count);
  std::vector<double> seconds(count);
  const auto answer = [&](size_t i, unsigned worker) {
    const double start = threadSeconds();
    answers[i] = workers(i, worker);
    seconds[i] = threadSeconds() - start;
    if (pointAnswered) pointAnswered();
  };
  if (!forEachIndex(count, options.threads, &signals_, answer, leave_)) return false;
  trial.answers.points = count;
  for (size_t i = 0; i < count; ++i) {
    trial.answers.values.push_back(answers[i].value);
    if (standardErrors) trial.estimates.push_back(answers[i].error);
    if (!timed) continue;
    const auto n = static_cast<double>(++trial.timed);
    trial.seconds += (seconds[i] - trial.seconds) / n;
    trial.directions += (static_cast<double>(answers[i].directions) - trial.directions) / n;
  }
  if (timed) trial.setupSeconds = std::max(trial.setupSeconds, setup);
  return true;
}

}  // namespace rsphere
