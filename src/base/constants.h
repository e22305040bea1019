#pragma once
#include <cmath>
#include <numbers>

namespace rsphere {

inline constexpr double kPi = std::numbers::pi, kPerPi = std::numbers::inv_pi;

// RADIANCE's luminous efficacy of white light, lm/W of equal-energy white from 380 to 780 nm.
inline constexpr double kPhotopicEfficacy = 179;

// Fresnel's reflectance of glass at normal incidence, for the refractive index 1.5.
inline constexpr double kGlassReflectance = .04;

// Threshold below which shares of light, cosines, slopes and roughnesses are treated as 0. RADIANCE's value.
inline constexpr double kNegligible = 1e-6;

inline double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

// The solid angle (sr) of a circular cone with this full angle at its apex (degrees).
inline double coneSolidAngle(double fullAngleDegrees) {
  // 4 pi sin^2(a/4) equals 2 pi (1 - cos(a/2)), but does not suffer from cancellation for small cones.
  const double s = std::sin(radians(fullAngleDegrees) / 4);
  return 4 * std::numbers::pi * s * s;
}

}  // namespace rsphere
