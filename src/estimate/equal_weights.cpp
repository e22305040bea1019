#include "estimate/equal_weights.h"

namespace rsphere {

SampledSet EqualWeights::sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace&) const {
  const std::vector<V3d> directions = set.turned(base_.directions);
  SampledSet sampled = traceEach(set, directions, base_.solidAngles, options_.everyDirection, tracer);
  if (base_.neighbours) sampled.setVariance(*base_.neighbours, base_);
  return sampled;
}

}  // namespace rsphere
