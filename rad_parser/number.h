#pragma once
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rad {

// Reads a real number in the notation of scene files: an optional sign, digits with at most one decimal point
// in any position, and an optional exponent ("1.", "+.5", "1e3"). Independent of the locale, and correctly
// rounded. Numbers too small for a double become zero. Empty for anything else ("1,5", "inf", "0x1", "1e999",
// "").
std::optional<double> parseReal(std::string_view word);

// Has the same result as std::from_chars(), bit by bit, but takes half the time for numbers of up to 15
// digits, which are nearly all numbers in scene files.
std::from_chars_result readReal(const char* first, const char* last, double& value);

// Powers of ten up to 22 are exact in a double: 5^22 < 2^53.
inline constexpr std::array<double, 23> kExactPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                        1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                        1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Reads an integer: an optional sign and digits. Empty for anything else, and for integers of more than 64
// bits.
std::optional<int64_t> parseInteger(std::string_view word);

}  // namespace rad
