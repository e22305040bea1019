#pragma once
// Contributions to a ray with the standard error of each, and as many rays as an accuracy of their sum takes
// (-oe and -Sa of rcontrib).
//
// The ray is estimated by the independent sets of RayEstimator, whose value here is the sum of all
// contributions. The standard error of a contribution follows from the spread of the sets. With eight sets,
// the error of a single bin is itself uncertain by about a quarter.
#include <vector>

#include "contrib/tracked.h"
#include "estimate/ray_estimator.h"

namespace rsphere {

class ContributionEstimator {
 public:
  // options.accuracy: the standard error of the sum of all contributions, relative to it. A floor below 0 is
  // that of the radiance in the scene, or, for coefficients, a fraction of a coefficient of 1. Keeps a
  // reference to the transport.
  ContributionEstimator(const Transport& transport, RayEstimator::Options options, Contributed what);

  struct Estimate {
    ContributionList means;
    std::vector<double> variances;  // of means.values(), in their order; (W/sr/m2)^2, (W/m2)^2, or without
                                    // a unit for coefficients
    RayEstimator::Estimate sum;     // of all contributions
  };
  // Parameters: PathTracer::trace().
  Estimate estimate(ContributionTracer& tracer, const V3d& origin, const V3d& direction, double farthest,
                    uint64_t seed) const;

 private:
  RayEstimator estimator_;
  const SpectralSampling* sampling_;
};

}  // namespace rsphere
