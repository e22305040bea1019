#pragma once
// Targets that are spots of daylight on diffuse surfaces (spots/bright_spots.h).
#include <span>
#include <vector>

#include "targets/target_finder.h"

namespace rsphere {

class SunlitTargets {
 public:
  explicit SunlitTargets(const TargetScene& scene);
  // See TargetFinder. Leaves out spots that are hidden according to up to four shadow rays.
  std::vector<FoundRegion> find(const V3d& point, double usual) const;

 private:
  const Tracer& tracer_;
  std::span<const BrightSpots::Sunlit> spots_;
};

}  // namespace rsphere
