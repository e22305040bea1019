#pragma once
#include "points/base_set.h"
#include "points/sampling_strategy.h"

namespace rsphere {

// -Sw h: only the base directions, with equal solid angles.
class EqualWeights : public SamplingStrategy {
 public:
  // Keeps references to both.
  EqualWeights(const SphereOptions& options, const BaseSet& base) : options_(options), base_(base) {}

  SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const override;

 private:
  const SphereOptions& options_;
  const BaseSet& base_;
};

}  // namespace rsphere
