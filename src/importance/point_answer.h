#pragma once
#include <cstddef>

#include "base/rgb.h"

namespace rsphere {

// The quantities of one point that the -o letters of sphere mode name. F is the integral of the radiance L
// over the sphere of directions (4 pi sr).
struct PointAnswer {
  V3d point{0, 0, 0};                  // o
  Rgb mean{0, 0, 0};                   // v  F/4pi, W/sr/m2
  Rgb standardError{0, 0, 0};          // e  of mean
  double brightnessError = 0;          //    and of its brightness: -pY
  Rgb scalarIrradiance{0, 0, 0};       // E  F/4, W/m2
  Rgb cylindricalIrradiance{0, 0, 0};  // C  (1/pi) integral of L sin(angle to z)
  Rgb facing[6] = {};                  // H  irradiances of the six faces, +x -x +y -y +z -z
  V3d lightVector{0, 0, 0};            // u  integral of L d, of brightness
  size_t directions = 0;               // k
  bool reached = true;                 // whether the standard error that -Sa asks for was reached
};

}  // namespace rsphere
