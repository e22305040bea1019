#pragma once
// Conversions between CIE X, Y, Z and red, green and blue for given primaries.
#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include <array>

namespace rsphere {

using Imath::M33d;
using Imath::V3d;

// Chromaticities x y of red, green, blue and white.
using Primaries = std::array<double, 8>;

// RADIANCE's nominal monitor, with equal-energy white.
inline constexpr Primaries kStandardPrimaries = {.640, .330, .290, .600, .150, .060, 1 / 3., 1 / 3.};

// The color space of sharpened sensors (Finlayson and Suesstrunk, CIC 2000), with RADIANCE's digits, and its
// inverse: xyz * kSharpFromXyz. Their product differs from the unit matrix by 9e-5, an error that rtrace's
// colors share.
inline const M33d kSharpFromXyz(1.2694, -.8364, .0297, -.0988, 1.8006, -.0315, -.1706, .0357, 1.0018);
inline const M33d kXyzFromSharp(.8156, .3791, -.0123, .0472, .5769, .0167, .1372, .0440, .9955);

// X, Y, Z of a chromaticity, with Y = 1. REQUIRES y other than 0.
V3d xyzOfChromaticity(double x, double y);

// The matrix whose rows are X, Y, Z of one unit of each primary: xyz = rgb * matrix. Their sum is white with
// Y = 1. REQUIRES primaries that do not lie on a line.
M33d xyzFromRgb(const Primaries& primaries);

// Mixes a color with gray of the same luminance (of white: 1) until no channel is negative. Black if the
// luminance is negative.
V3d intoGamut(const V3d& color, double luminance);

}  // namespace rsphere
