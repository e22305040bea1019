#pragma once
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rad {

// A real number as the scene language spells it: digits with at most one point among, before or after them, a
// sign before, an exponent behind ("1.", "+.5", "1e3"). Independent of the locale, correctly rounded. What is
// too small for a double is zero. Empty for anything else ("1,5", "inf", "0x1", "1e999", "").
std::optional<double> parseReal(std::string_view word);

// std::from_chars() for the number at the beginning of a text, bit by bit the same, in half the time for
// numbers of up to 15 digits: those of nearly every file.
std::from_chars_result readReal(const char* first, const char* last, double& value);

// An integer: digits with a sign before. Empty for anything else, and beyond 64 bits.
std::optional<int64_t> parseInteger(std::string_view word);

}  // namespace rad
