#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace rsphere {

// Red, green and blue of each pixel (W/sr/m2, or screen colors from 0 to 1), beginning with the highest row.
struct Raster {
  int width = 0, height = 0;
  std::vector<float> pixels;
};

// The contents of a PNG file: screen colors from 0 to 1, which are rounded to 8 bits and marked as sRGB.
// Values beyond are clipped. Source: ISO/IEC 15948, "Portable Network Graphics".
std::string pngPicture(const Raster& raster);

// The contents of a RADIANCE picture: `header` (lines with line ends, beginning with "#?RADIANCE"), FORMAT,
// the resolution, and 4-byte pixels (rgbePixel(), image/rgbe.h: each channel is rounded down by up to 1/128
// of the largest). Scanlines are run-length coded, unless the width is below 8 or above 32767. Source:
// RADIANCE file formats, "Picture file format".
std::string radiancePicture(const Raster& raster, std::string_view header);

// The sRGB value, 0 to 1, of a linear value of at least 0; values above 1 are clipped. Source: IEC 61966-2-1.
inline double sRgb(double x) {
  return x <= .0031308 ? 12.92 * x : 1.055 * std::pow(std::min(x, 1.), 1 / 2.4) - .055;
}

// The linear value whose sRGB value is .5.
inline constexpr double kMidBright = .21404114;

}  // namespace rsphere
