#pragma once
// Final gathers for the irradiance cache and the coarse solution. Their paths start with a new state and do
// not depend on the path that requested them.
#include "field/coarse_solution.h"
#include "field/hemisphere.h"

namespace rsphere {

class SiteGatherer {
 public:
  // The indirect light of a site, estimated with -ad + -as rays. nearest: of HemisphereCells::sum(). depth: of
  // the ray that requests it; only the limit of nesting depends on it.
  virtual GatheredLight gather(const GatherSite& site, double nearest, uint64_t seed, int depth) = 0;

  // Sends about `rays` rays from a patch of the coarse solution, and records the patches and the light
  // that they find.
  virtual void link(const GatherSite& site, int rays, uint64_t seed, int depth,
                    CoarseSolution::Links& links) = 0;

 protected:
  ~SiteGatherer() = default;
};

}  // namespace rsphere
