#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "base/color.h"

namespace rsphere {

// The 4-byte pixel of a RADIANCE picture: the mantissas of red, green and blue, and the shared exponent +
// 128. Each channel is rounded to float, and then down to a multiple of 2^(e-8), where 2^e is the smallest
// power of two above the largest channel. Negative channels become 0. If the largest channel is at most 1e-32
// or all are NaN, all four bytes are 0. Values of 2^127 and above result in the largest pixel. Source:
// RADIANCE file formats, "Picture file format"; G. Ward, "Real Pixels", Graphics Gems II.
std::array<uint8_t, 4> rgbePixel(const Color& c);

// Appends the pixel of a hyperspectral picture ("Radiance_spectra"): a mantissa for each band, then the
// shared exponent + 128, by the rules of rgbePixel().
void appendSpectralPixel(std::span<const double> bands, std::string& bytes);

}  // namespace rsphere
