#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"

namespace rsphere {

// What rtrace writes where a ray hits nothing, or a distant source, as a length.
inline constexpr double kInfiniteLength = 1e10;

// What is known of one ray, for the -o letters of ray mode and of -Sd. A field that no chosen letter names
// may be left as it is. Names are "*" where nothing was hit; they must live as long as the scene does.
struct RayAnswer {
  V3d origin{0, 0, 0}, direction{0, 0, 0};    // o d
  Rgb value{0, 0, 0};                         // v  radiance W/sr/m2, or irradiance W/m2 under -i -I
  Rgb mirroredContribution{0, 0, 0};          // r
  Rgb unmirroredContribution{0, 0, 0};        // x
  double mirroredLength = kInfiniteLength;    // R
  double unmirroredLength = kInfiniteLength;  // X
  double effectiveLength = kInfiniteLength;   // l
  double firstLength = kInfiniteLength;       // L
  double u = 0, v = 0;                        // c  local surface coordinates
  V3d point{0, 0, 0};                         // p
  V3d normal{0, 0, 0};                        // n  perturbed, facing the ray
  V3d unperturbedNormal{0, 0, 0};             // N  as the surface has it
  std::string_view surface = "*", modifier = "*", material = "*";  // s m M
  double rayWeight = 1;                                            // w
  Rgb contribution{1, 1, 1};  // W  share of its value in that of the primary ray; times value: V
  double solidAngle = 0;      // w under -Sd, sr
};

// What is known of one point, for the -o letters of sphere mode. With F the integral of radiance over 4 pi
// sr.
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
