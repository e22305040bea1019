#pragma once
#include <numbers>

namespace rsphere {

inline constexpr double kPi = std::numbers::pi, kPerPi = std::numbers::inv_pi;

// RADIANCE's luminous efficacy of white light, lm/W of equal-energy white from 380 to 780 nm.
inline constexpr double kPhotopicEfficacy = 179;

// Fresnel's reflectance of glass at normal incidence, for the refractive index 1.5.
inline constexpr double kGlassReflectance = .04;

// Threshold below which shares of light, cosines, slopes and roughnesses are treated as 0. RADIANCE's value.
inline constexpr double kNegligible = 1e-6;

}  // namespace rsphere
