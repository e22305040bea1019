#include "estimate/equal_weights.h"

namespace rsphere {

SampledSet EqualWeights::sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace&) const {
  const std::vector<V3d> directions = set.turned(base_.directions);
  SampledSet sampled = traceEach(set, directions, base_.solidAngles, options_.everyDirection, tracer);
  sampled.ofZones = ZoneVariances(base_.zones.get());
  if (base_.neighbours)
    sampled.variance =
        evenVariance(sampled.samples, *base_.neighbours, base_.sampling, zonesOf(sampled.ofZones));
  return sampled;
}

}  // namespace rsphere
