#pragma once
// The rays that the irradiance cache and the coarse solution request. This folder traces no rays itself.
#include <cstdint>
#include <span>

#include "field/hemisphere.h"
#include "field/patch_links.h"

namespace rsphere {

// Implemented in transport/final_gather.h. All results depend only on the arguments.
class FieldRays {
 public:
  // The indirect light at a site, estimated with -ad + -as rays. nearest: as in HemisphereCells::sum().
  virtual GatheredLight gather(const GatherSite& site, double nearest, uint64_t seed) = 0;
  // Links of a patch from about `rays` rays. They start at the patch's sites in turn and sample the
  // hemispheres over them. REQUIRES at least one site.
  virtual PatchLinks link(std::span<const PatchSite> sites, int rays, uint64_t seed) = 0;
  // The distance to the first surface above the site along its normal, at most `farthest` (world units).
  virtual double clearance(const GatherSite& site, double farthest) = 0;
  // The distances of the surfaces around a site, estimated from a few directions.
  virtual Surroundings surroundings(const GatherSite& site) = 0;
  // Whether the segment between two points is unoccluded.
  virtual bool sees(const V3d& from, const V3d& to) = 0;
  // Whether an object narrower than `side`, the side of the site's cell (world units), lies within that
  // distance of the site. Objects in the surface's own plane, which is `lift` below the site, are ignored.
  virtual bool smallObjectNear(const GatherSite& site, double side, double lift) = 0;

 protected:
  ~FieldRays() = default;
};

}  // namespace rsphere
