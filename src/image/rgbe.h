#pragma once
#include <array>
#include <cstdint>

#include "base/rgb.h"

namespace rsphere {

// The 4-byte pixel of a RADIANCE picture: the mantissas of red, green and blue, and the shared exponent +
// 128. Each channel is rounded to float first, and then down to a multiple of 2^(e-8), where 2^e is the
// smallest power of two above the largest channel. A largest channel of at most 1e-32, or nan: all four bytes
// are 0. Beyond 2^127: the largest pixel. Negative channels become 0. Source: RADIANCE file formats, "Picture
// file format"; G. Ward, "Real Pixels", Graphics Gems II.
std::array<uint8_t, 4> rgbePixel(const Rgb& c);

}  // namespace rsphere
