#pragma once
#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

namespace rsphere {

// Three channels. Radiance, irradiance and coefficients have types of their own where they are handed on
// (radiometry.h). Elsewhere, for the colors of materials and within functions, the name of the variable says
// what it is.
using Rgb = Imath::Color3<double>;
using Imath::V3d;

// Weights of the channels in the brightness, for RADIANCE's primaries and its white point (1/3, 1/3). rtrace
// -pY, thresholds and the light vector use this brightness.
inline constexpr double kRedWeight = .265105820, kGreenWeight = .670105820, kBlueWeight = .064788360;
inline double brightness(const Rgb& c) { return kRedWeight * c.x + kGreenWeight * c.y + kBlueWeight * c.z; }
inline double maxChannel(const Rgb& c) {
  return c.x > c.y ? (c.x > c.z ? c.x : c.z) : (c.y > c.z ? c.y : c.z);
}
inline bool isBlack(const Rgb& c) { return !(maxChannel(c) > 0); }

}  // namespace rsphere
