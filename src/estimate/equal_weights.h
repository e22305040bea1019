#pragma once
#include "points/base_set.h"
#include "points/sampling_strategy.h"

namespace rsphere {

// -Sw h: only the base directions, with equal solid angles.
class EqualWeights : public SamplingStrategy {
 public:
  // Keeps references to both.
  EqualWeights(const SphereOptions& options, const BaseSet& base) : options_(options), base_(base) {}

  SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace&) const override {
    const std::vector<V3d> directions = set.turned(base_.directions);
    SampledSet sampled = traceEach(set, directions, base_.solidAngles, options_.everyDirection, tracer);
    if (base_.neighbours) sampled.setVariance(*base_.neighbours, base_);
    return sampled;
  }

 private:
  const SphereOptions& options_;
  const BaseSet& base_;
};

}  // namespace rsphere
