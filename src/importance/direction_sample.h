#pragma once
#include "base/rgb.h"

namespace rsphere {

// One traced direction of a point.
struct DirectionSample {
  V3d direction{0, 0, 1};  // unit, world
  double solidAngle = 0;   // that it represents, sr
  Rgb value{0, 0, 0};      // radiance from there, W/sr/m2
  bool toSource = false;   // whether it was sent to a light source that is integrated separately
};

}  // namespace rsphere
