#pragma once
// The rays that the irradiance cache and the coarse solution need. They trace none themselves.
#include <cstdint>

#include "field/hemisphere.h"
#include "field/patch_links.h"

namespace rsphere {

// Implemented in transport/final_gather.h. Every answer depends on nothing but the arguments.
class FieldRays {
 public:
  // The indirect light of a site, estimated with -ad + -as rays. nearest: of HemisphereCells::sum().
  virtual GatheredLight gather(const GatherSite& site, double nearest, uint64_t seed) = 0;
  // What about `rays` rays over the hemisphere of a patch's site find.
  virtual PatchLinks link(const GatherSite& site, int rays, uint64_t seed) = 0;
  // The distance, at most `farthest`, to what lies above the site along its normal (world units).
  virtual double clearance(const GatherSite& site, double farthest) = 0;
  // How far the surfaces around a site are, estimated in a few directions.
  virtual Surroundings surroundings(const GatherSite& site) = 0;
  // Whether the segment between two points is unoccluded.
  virtual bool sees(const V3d& from, const V3d& to) = 0;
  // Whether an object narrower than the side of the site's cell (world units) lies within that distance, and
  // not in the plane of the site, which is the lift above its surface.
  virtual bool smallObjectNear(const GatherSite& site, double side, double lift) = 0;

 protected:
  ~FieldRays() = default;
};

}  // namespace rsphere
