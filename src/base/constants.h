#pragma once
#include <numbers>

namespace rsphere {

inline constexpr double kPi = std::numbers::pi, kPerPi = std::numbers::inv_pi;

// Shares of light, cosines, slopes and roughnesses below this are treated as 0. RADIANCE's own figure.
inline constexpr double kNegligible = 1e-6;

}  // namespace rsphere
