#pragma once
#include <cmath>
#include <numbers>

namespace rsphere {

inline double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

// The solid angle (sr) of a circular cone with this full angle at its apex (degrees).
inline double coneSolidAngle(double fullAngleDegrees) {
  // 4 pi sin^2(a/4) equals 2 pi (1 - cos(a/2)), but does not suffer from cancellation for small cones.
  const double s = std::sin(radians(fullAngleDegrees) / 4);
  return 4 * std::numbers::pi * s * s;
}

}  // namespace rsphere
