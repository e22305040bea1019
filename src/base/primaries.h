#pragma once
// Conversions between CIE X, Y, Z and red, green and blue for given primaries.
#include <Imath/ImathVec.h>

#include <array>

namespace rsphere {

using Imath::V3d;

using Matrix = std::array<std::array<double, 3>, 3>;  // rows

// Chromaticities x y of red, green, blue and white.
using Primaries = std::array<double, 8>;

// RADIANCE's nominal monitor, with equal-energy white.
inline constexpr Primaries kStandardPrimaries = {.640, .330, .290, .600, .150, .060, 1 / 3., 1 / 3.};

Matrix product(const Matrix& a, const Matrix& b);
V3d product(const Matrix& a, const V3d& v);
double determinant(const Matrix& m);
Matrix inverse(const Matrix& m);  // REQUIRES a determinant other than 0

// X, Y, Z of a chromaticity, with Y = 1. REQUIRES y other than 0.
V3d xyzOfChromaticity(double x, double y);

// The matrix whose columns are X, Y, Z of one unit of each primary. Their sum is white with Y = 1. REQUIRES
// primaries that do not lie on a line.
Matrix xyzFromRgb(const Primaries& primaries);

// Mixes a color with gray of the same luminance (of white: 1) until no channel is negative. Black if the
// luminance is negative.
V3d intoGamut(const V3d& color, double luminance);

}  // namespace rsphere
