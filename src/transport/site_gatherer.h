#pragma once
// Final gathers, as the irradiance cache and the coarse solution ask for them. Their paths begin anew: they
// depend on nothing of the path that caused them.
#include "field/coarse_solution.h"
#include "field/hemisphere.h"

namespace rsphere {

class SiteGatherer {
 public:
  // The indirect light of a site, by -ad + -as rays. depth: of the ray that asks for it; only the limit of
  // nesting depends on it.
  virtual GatheredLight gather(const GatherSite& site, uint64_t seed, int depth) = 0;

  // Sends about `rays` rays from a patch of the coarse solution, and notes the patches and the light that
  // they find.
  virtual void link(const GatherSite& site, int rays, uint64_t seed, int depth,
                    CoarseSolution::Links& links) = 0;

 protected:
  ~SiteGatherer() = default;
};

}  // namespace rsphere
