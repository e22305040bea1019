#pragma once
// Targets that show daylight: openings, their images in mirrors, and sunlit spots.
#include <span>
#include <vector>

#include "openings/openings.h"
#include "targets/target_finder.h"

namespace rsphere {

// Openings.
class OpeningTargets {
 public:
  // Leaves out openings that contain special objects: these are targets themselves (special_targets.h).
  explicit OpeningTargets(const TargetScene& scene);
  // See TargetFinder.
  std::vector<FoundRegion> find(const V3d& point, double usual) const;

 private:
  std::vector<Opening> openings_;
};

// Images of openings in flat mirrors. An image is far brighter than the rest of the mirror, and may be small
// in it, so that it is a separate target.
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

// Images of openings in mirroring balls and cylinders, such as columns and rails of chrome. They are small,
// and far brighter than the rest of the object (see glints.h).
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

// Spots of daylight on diffuse surfaces (spots/bright_spots.h).
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
