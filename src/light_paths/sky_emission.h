#pragma once
// Starts light paths on portals (portals.h), for all light that comes through them except direct sunlight.
#include <vector>

#include "base/function_ref.h"
#include "base/radiometry.h"
#include "base/random.h"
#include "openings/portals.h"
#include "scene/shape.h"

namespace rsphere {

// The light beyond portals, found by paths from the eye: the radiance (W/sr/m2) along an indirect ray. Light
// paths receive it as a function, because PathTracer, which computes it, depends on light paths. bounces:
// number of diffuse bounces that have led to the ray.
using OutdoorRadiance =
    FunctionRef<Radiance(const V3d& origin, const V3d& direction, int bounces, Random& random)>;

// OutdoorRadiance, separated by the number of further diffuse bounces: element i of the result is the light
// after i bounces.
using OutdoorParts = FunctionRef<void(const V3d& origin, const V3d& direction, int bounces, Random& random,
                                      std::vector<Radiance>& parts)>;

// Constant. Keeps a reference to the portals.
class SkyEmission {
 public:
  // paths: the number of paths from all portals together; 0: there are none.
  SkyEmission(const Portals& portals, double paths);

  // Expected mean power of a path, W (brightness).
  double pathPower() const { return pathPower_; }

  struct Leaving {
    V3d origin{0, 0, 0}, direction{0, 0, 1};  // world; unit
    Irradiance power;                         // of the path, W
    // Number of bounces of its light when it arrives at the first surface: the bounces outdoors plus 1,
    // because paths from the eye find this light by an indirect ray. All light of a path has this number.
    int bounces = 0;
  };
  // where: 0 to 1, selects the portal. most: limit on the bounces of the light; below 1: no light.
  Leaving leave(double where, int most, Random& random, OutdoorParts outdoors) const;

 private:
  const Portals& portals_;
  double pathPower_ = 0;
  double sum_ = 0;  // of area times radiance over the portals
};

}  // namespace rsphere
