#include "rad_parser/number.h"

#include <algorithm>
#include <charconv>

namespace rad {
namespace {

bool isDigit(char c) { return '0' <= c && c <= '9'; }

// Whether a number that a double cannot hold is too small rather than too large. digits: a valid number, no
// sign.
bool tooSmall(std::string_view digits) {
  const size_t e = digits.find_first_of("eE");
  const std::string_view mantissa = digits.substr(0, e);
  int32_t exponent = 0;
  if (e != digits.npos) {
    std::string_view word = digits.substr(e + 1);
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), exponent);
    if (fault != std::errc()) return word.starts_with('-');
  }
  const size_t first = mantissa.find_first_of("123456789");
  if (first == mantissa.npos) return true;
  const size_t point = std::min(mantissa.find('.'), mantissa.size());
  return exponent + static_cast<int64_t>(point) - static_cast<int64_t>(first) < 0;
}

}  // namespace

std::optional<double> parseReal(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || (!isDigit(word[0]) && word[0] != '.')) return {};  // from_chars would take inf and nan
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
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
