#include "importance/equal_weights.h"

namespace rsphere {

SampledSet EqualWeights::sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace&) const {
  SampledSet sampled;
  const std::vector<V3d> directions = set.turned(base_.directions);
  sampled.samples.reserve(directions.size());
  for (size_t i = 0; i < directions.size(); ++i) {
    const Ray ray = tracer.trace(set.point(), directions[i], 0, mixBits(set.seed() + i));
    sampled.samples.push_back({directions[i], base_.solidAngles[i], ray.value});
    if (options_.everyDirection) sampled.rays.push_back(ray);
  }
  if (base_.neighbours)
    sampled.variance =
        baseVariance(sampled.samples, *base_.neighbours, std::vector<bool>(directions.size(), true));
  return sampled;
}

}  // namespace rsphere
