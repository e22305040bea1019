#pragma once
#include <algorithm>
#include <cmath>

namespace rsphere {

// The sRGB value, 0 to 1, of a linear value of at least 0; values above 1 are clipped. Source: IEC 61966-2-1.
inline double sRgb(double x) {
  return x <= .0031308 ? 12.92 * x : 1.055 * std::pow(std::min(x, 1.), 1 / 2.4) - .055;
}

// The linear value whose sRGB value is .5.
inline constexpr double kMidBright = .21404114;

}  // namespace rsphere
