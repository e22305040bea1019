#pragma once
#include "base/radiometry.h"

namespace rsphere {

// One traced direction of a point.
struct DirectionSample {
  V3d direction{0, 0, 1};  // unit, world
  double solidAngle = 0;   // that it represents, sr
  Radiance value;          // from there
  bool toSource = false;   // whether it was sent to a light source that is integrated separately
};

}  // namespace rsphere
