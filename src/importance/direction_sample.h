#pragma once
#include "cli/rgb.h"

namespace rsphere {

// A direction of a point: unit, the solid angle it stands for (sr) and the radiance from there (W/sr/m2).
struct DirectionSample {
  V3d direction{0, 0, 1};
  double solidAngle = 0;
  Rgb value{0, 0, 0};
  bool toSource = false;  // aimed at a light source that is integrated apart
};

}  // namespace rsphere
