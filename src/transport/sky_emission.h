#pragma once
// Starts light paths on portals (portals.h), for all light that comes through them but direct sunlight.
#include "transport/outdoor_light.h"
#include "transport/portals.h"

namespace rsphere {

// Constant. Keeps a reference to the portals.
class SkyEmission {
 public:
  // paths: the number of paths from all portals together; 0: there are none.
  SkyEmission(const Portals& portals, double paths);

  // Mean power of a path as expected, W (brightness).
  double pathPower() const { return pathPower_; }

  struct Leaving {
    V3d origin{0, 0, 0}, direction{0, 0, 1};  // world; unit
    Irradiance power;                         // of the path, W
    // That count for the light on its first surface: one, and those outdoors. Each path carries the light of
    // one number of bounces.
    int bounces = 0;
  };
  // where: from 0 to 1, chooses the portal. most: of Leaving::bounces.
  Leaving leave(double where, int most, Random& random, OutdoorParts outdoors) const;

 private:
  const Portals& portals_;
  double pathPower_ = 0;
};

}  // namespace rsphere
