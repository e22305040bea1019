#include "rad_parser/number.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <locale>
#include <sstream>
#include <string>

namespace rad {
namespace {

bool isDigit(char c) { return '0' <= c && c <= '9'; }

// Whether a number that a double cannot represent is too small rather than too large. digits: a valid number
// without sign.
bool tooSmall(std::string_view digits) {
  std::istringstream text{std::string(digits)};
  text.imbue(std::locale::classic());
  double nearest = 0;
  text >> nearest;
  return nearest < 1;
}

// Powers of ten, by the number of digits that are read together.
constexpr std::array<uint64_t, 9> kScale = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

// Reads digits, eight at a time if that many characters are left. The number of digits among the eight is
// found without branches.
const char* readDigits(const char* at, const char* last, uint64_t& value) {
  static_assert(std::endian::native == std::endian::little);
  while (last - at >= 8) {
    uint64_t text = 0;
    std::memcpy(&text, at, 8);
    text ^= 0x3030303030303030;  // replaces digits by their values
    const uint64_t others = ((text + 0x0606060606060606) | text) & 0xf0f0f0f0f0f0f0f0;
    const int count = others ? std::countr_zero(others) / 8 : 8;
    if (count == 0) return at;
    // Puts zeros before the digits, then combines digits to pairs, pairs to fours, and fours to eight digits.
    text <<= 64 - 8 * count;
    text = text * 10 + (text >> 8);
    text = ((text & 0x000000ff000000ff) * (100 + (uint64_t{1000000} << 32)) +
            (text >> 16 & 0x000000ff000000ff) * (1 + (uint64_t{10000} << 32))) >>
           32;
    value = value * kScale[static_cast<size_t>(count)] + text;
    at += count;
    if (count < 8) return at;
  }
  for (; at != last && isDigit(*at); ++at) value = 10 * value + static_cast<uint64_t>(*at - '0');
  return at;
}

}  // namespace

// A whole number below 10^15 and a power of ten up to 10^22 are exact in a double, so a single multiplication
// or division of the two is correctly rounded (Clinger, "How to Read Floating Point Numbers Accurately", PLDI
// 1990). All other numbers are left to the library.
std::from_chars_result readReal(const char* first, const char* last, double& value) {
  const char* at = first;
  const bool negative = at != last && *at == '-';
  at += negative;
  uint64_t digits = 0;
  const char* const whole = at;
  for (; at != last && isDigit(*at); ++at) digits = 10 * digits + static_cast<uint64_t>(*at - '0');
  ptrdiff_t count = at - whole, exponent = 0;
  if (at != last && *at == '.') {
    const char* const fraction = ++at;
    at = readDigits(at, last, digits);
    exponent = fraction - at;
    count -= exponent;
  }
  if (at != last && (*at == 'e' || *at == 'E')) {
    ++at;
    const bool down = at != last && *at == '-';
    at += at != last && (*at == '-' || *at == '+');
    const char* const power = at;
    ptrdiff_t size = 0;
    for (; at != last && isDigit(*at) && at - power < 3; ++at) size = 10 * size + (*at - '0');
    if (at == power || (at != last && isDigit(*at))) count = 0;
    exponent += down ? -size : size;
  }
  constexpr auto kLargest = static_cast<ptrdiff_t>(kExactPowers.size()) - 1;
  if (count == 0 || count > 15 || exponent < -kLargest || exponent > kLargest)
    return std::from_chars(first, last, value);
  const auto integer = static_cast<double>(digits);
  const double size = exponent < 0 ? integer / kExactPowers[static_cast<size_t>(-exponent)]
                                   : integer * kExactPowers[static_cast<size_t>(exponent)];
  value = negative ? -size : size;
  return {at, std::errc()};
}

std::optional<double> parseReal(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || (!isDigit(word[0]) && word[0] != '.')) return {};  // from_chars accepts inf and nan
  double value = 0;
  const auto [end, fault] = readReal(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return {};
  if (fault == std::errc::result_out_of_range) {
    if (!tooSmall(word)) return {};
    value = 0;
  } else if (fault != std::errc()) {
    return {};
  }
  return negative ? -value : value;
}

std::optional<int64_t> parseInteger(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return {};
  }
  int64_t value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

}  // namespace rad
