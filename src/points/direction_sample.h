#pragma once
#include <cstdint>

#include "base/radiometry.h"

namespace rsphere {

// Identifies a part of the sphere: the directions that lie in a certain combination of targets (targets.h). A
// cell never extends from one part into another. kNoRegion: the direction is left out of the mean, because
// other directions represent its solid angle.
using RegionId = uint64_t;
inline constexpr RegionId kNoRegion = UINT64_MAX;

// One traced direction of a point.
struct DirectionSample {
  V3d direction{0, 0, 1};  // unit, world
  double solidAngle = 0;   // solid angle that it represents, sr
  Radiance value{};        // radiance from the direction, W/sr/m2
  bool toSource = false;   // whether it was sent to a light source that is integrated separately
  Radiance glanced{};      // the part of the value that a glance along it has found; 0 without -Sd
  RegionId region = 0;
};

}  // namespace rsphere
