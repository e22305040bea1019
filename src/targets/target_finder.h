#pragma once
// The interface of a way to find targets: regions of the sphere of directions at a point that get extra
// directions. It is for directions from points what LightFinder (openings/light_finder.h) is for gathers.
#include <concepts>
#include <span>
#include <vector>

#include "glances/sphere_tracing.h"
#include "silhouettes/silhouette.h"
#include "targets/contrasts.h"

namespace rsphere {

// A region of the directions from a point.
struct FoundRegion {
  Silhouette silhouette;   // approximate
  double deviation = 0;    // standard deviation of its radiance, W/sr/m2
  double daylight = 0;     // mean radiance of the daylight that it may show, W/sr/m2; 0: not an opening
  bool continues = false;  // part of one image together with the preceding region
};

// What finders are made from. They may keep references to all but `objects`.
struct TargetScene {
  const SphereTracing& tracing;
  std::span<const SpecialObject> objects;
  const Contrasts& contrasts;  // of the objects
};

// Shared by all threads. Missed and misplaced regions change the variance of estimates, not their mean.
template <class Finder>
concept TargetFinder = requires(const TargetScene& scene, const Finder& finder, const V3d& point,
                                double usual) {
  Finder(scene);
  // The regions seen from a point (world) that may vary more than `usual`, the standard deviation of the
  // radiance elsewhere (W/sr/m2). The result depends only on the scene, the options and the arguments.
  { finder.find(point, usual) } -> std::same_as<std::vector<FoundRegion>>;
};

// Finders, and what all of them find.
template <TargetFinder... Finder>
class TargetFinders : Finder... {
 public:
  explicit TargetFinders(const TargetScene& scene) : Finder(scene)... {}

  std::vector<FoundRegion> find(const V3d& point, double usual) const {
    std::vector<FoundRegion> all;
    const auto add = [&](std::vector<FoundRegion> found) {
      std::ranges::move(found, std::back_inserter(all));
    };
    (add(Finder::find(point, usual)), ...);
    return all;
  }
};

}  // namespace rsphere
