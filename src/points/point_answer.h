#pragma once
// The answer at a point: integrals over weighted directions, each of which was traced. This folder has what
// the strategies (-Sw) share: options, base directions, samples (direction_sample.h), their moments, and the
// error of a mean (error_estimate.h).
#include <cstddef>
#include <vector>

#include "base/constants.h"
#include "base/radiometry.h"

namespace rsphere {

// The quantities at one point, each with its -o letter in sphere mode. F is the integral of the radiance L
// over the sphere of directions (4 pi sr).
struct PointAnswer {
  V3d point{0, 0, 0};                // o
  Radiance mean;                     // v  F/4pi
  Radiance standardError;            // e  of mean
  double brightnessError = 0;        // standard error of its brightness, for -pY
  Irradiance scalarIrradiance;       // E  F/4
  Irradiance cylindricalIrradiance;  // C  (1/pi) integral of L sin(angle to z)
  Irradiance facing[6];              // H  irradiances of the six faces, +x -x +y -y +z -z
  V3d lightVector{0, 0, 0};          // u  integral of L d, of brightness
  size_t directions = 0;             // k
  // S  (1/pi) integral of L sin(angle to z) (1 + cos(azimuth to `towards`)): of the curved surface of a half
  // cylinder. towards: unit, horizontal.
  Irradiance semicylindricalIrradiance(const V3d& towards) const {
    return cylindricalIrradiance +
           ((facing[0] - facing[1]) * towards.x + (facing[2] - facing[3]) * towards.y) / kPi;
  }
  // h  1/4 integral of L (1 + cos(angle to z)): of the curved surface of a half sphere on a horizontal base.
  Irradiance hemisphericalIrradiance() const { return scalarIrradiance + (facing[4] - facing[5]) / 4.; }
  // z  mean radiances of the zones (-Sz), and Z: their standard errors
  std::vector<Radiance> zones;
  struct OwnError {
    Radiance channels;
    double brightness = 0;
  };
  std::vector<OwnError> zoneErrors;      // empty unless standard errors are wanted
  std::vector<OwnError> quantityErrors;  // W/m2, by Kernels::Quantity; empty unless wanted
  bool isDark = false;       // almost no direction found light, or -Sa stopped because there was so
                             // little
  double relativeError = 0;  // brightnessError relative to the mean's brightness, or to the floor of -Sa
  bool reached = true;       // whether the standard error requested with -Sa was reached
};

}  // namespace rsphere
