#pragma once
// Targets that are images of openings, which show daylight, in mirroring balls and cylinders, such as columns
// and rails of chrome. They are small and far brighter than the rest of the object (see glints.h).
#include <vector>

#include "openings/openings.h"
#include "targets/target_finder.h"

namespace rsphere {

class CurvedImages {
 public:
  // Uses the special objects that are balls or cylinders, seen from outside, of the materials in glints.h.
  explicit CurvedImages(const TargetScene& scene);
  // See TargetFinder. Leaves out images whose solid angle (sr) times squared radiance is below
  // leastGlint(usual), and images of whose opening up to ten shadow rays find nothing.
  std::vector<FoundRegion> find(const V3d& point, double usual) const;

 private:
  // A cylinder, or a ball if the length and the axis are 0.
  struct Mirror {
    V3d base, axis;
    double length, radius, reflectance;

    V3d nearestOnAxis(const V3d& place) const;
    // Where it mirrors a place towards the point.
    SurfacePoint towards(const V3d& point, const V3d& place) const;
  };
  bool isVisible(const Mirror& mirror, const Opening& opening, const V3d& point) const;

  const PreparedScene& prepared_;
  const Openings* openings_;  // null: none
  std::vector<Mirror> mirrors_;
};

}  // namespace rsphere
