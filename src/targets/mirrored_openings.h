#pragma once
// Targets that are images of openings, which show daylight, in flat mirrors. An image is far brighter than
// the rest of the mirror, and may be small in it, so that it is a separate target.
#include <vector>

#include "targets/target_finder.h"

namespace rsphere {

class MirroredOpenings {
 public:
  explicit MirroredOpenings(const TargetScene& scene)
      : prepared_(scene.tracing.prepared), images_(scene.tracing.aims.of<OpeningImages>()) {}
  // See TargetFinder. Leaves out images whose solid angle (sr) times squared radiance is below
  // leastGlint(usual), and images that are hidden according to up to ten shadow rays.
  std::vector<FoundRegion> find(const V3d& point, double usual) const;

 private:
  const PreparedScene& prepared_;
  const OpeningImages* images_;  // null: none
};

}  // namespace rsphere
