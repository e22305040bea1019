#pragma once
// Targets that are openings, which show daylight.
#include <vector>

#include "targets/target_finder.h"

namespace rsphere {

class OpeningTargets {
 public:
  // Leaves out openings that contain special objects: these are targets themselves (special_targets.h).
  explicit OpeningTargets(const TargetScene& scene);
  // See TargetFinder.
  std::vector<FoundRegion> find(const V3d& point, double usual) const;

 private:
  std::vector<Opening> openings_;
};

}  // namespace rsphere
