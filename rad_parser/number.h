#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace rad {

// A real number as the scene language spells it: digits with at most one point among, before or after them, a
// sign before, an exponent behind ("1.", "+.5", "1e3"). Independent of the locale, correctly rounded. What is
// too small for a double is zero. Empty for anything else ("1,5", "inf", "0x1", "1e999", "").
std::optional<double> parseReal(std::string_view word);

// An integer: digits with a sign before. Empty for anything else, and beyond 64 bits.
std::optional<int64_t> parseInteger(std::string_view word);

}  // namespace rad
