#include "records/number_text.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "rad_parser/number.h"

namespace rsphere {
namespace {

constexpr int kDigits = 7;  // digits printed by "%e", before and after the point

constexpr int kLargestExactPower = rad::kExactPowers.size() - 1;

constexpr std::array<char, 200> kPairs = [] {
  std::array<char, 200> pairs{};
  for (int i = 0; i < 100; ++i) {
    pairs[2 * i] = static_cast<char>('0' + i / 10);
    pairs[2 * i + 1] = static_cast<char>('0' + i % 10);
  }
  return pairs;
}();

void appendLibrary(std::string& text, double x) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, x, std::chars_format::scientific, kDigits - 1);
  text.append(digits, end.ptr);
}

}  // namespace

void appendScientific(std::string& text, double x) {
  const double size = std::fabs(x);
  const int binaryExponent = static_cast<int>(std::bit_cast<uint64_t>(size) >> 52) - 1023;
  // floor(log10(size)), or one less: 1233/4096 is slightly below log10(2).
  int exponent = (binaryExponent * 1233) >> 12;
  const int power = kDigits - 1 - exponent;
  // The exponents of zero, denormals, infinity and nan are far outside this range.
  if (power > kLargestExactPower || power - 1 < -kLargestExactPower) {
    if (size == 0) {
      text.append(std::signbit(x) ? "-0.000000e+00" : "0.000000e+00");
      return;
    }
    return appendLibrary(text, x);
  }
  double scaled = power >= 0 ? size * rad::kExactPowers[power] : size / rad::kExactPowers[-power];
  if (scaled >= 1e7) {
    ++exponent;
    scaled = power >= 1 ? size * rad::kExactPowers[power - 1] : size / rad::kExactPowers[1 - power];
  }
  // `scaled` is below 1e7 and was rounded once, so its error is below 2^-53 * 1e7 = 1.2e-9. If it is within
  // 1e-8 of the middle between two integers, exact arithmetic of the library decides.
  auto digits = static_cast<uint32_t>(scaled);
  const double rest = scaled - digits;
  if (std::fabs(rest - 0.5) < 1e-8) return appendLibrary(text, x);
  digits += rest > 0.5;
  if (digits >= 10000000) {
    digits = 1000000;
    ++exponent;
  }
  char out[16];
  char* p = out;
  if (std::signbit(x)) *p++ = '-';
  const uint32_t first = digits / 1000000, rest6 = digits % 1000000;
  *p++ = static_cast<char>('0' + first);
  *p++ = '.';
  std::memcpy(p, &kPairs[2 * (rest6 / 10000)], 2);
  std::memcpy(p + 2, &kPairs[2 * (rest6 / 100 % 100)], 2);
  std::memcpy(p + 4, &kPairs[2 * (rest6 % 100)], 2);
  p += 6;
  *p++ = 'e';
  *p++ = exponent < 0 ? '-' : '+';
  std::memcpy(p, &kPairs[2 * std::abs(exponent)], 2);
  text.append(out, p + 2);
}

}  // namespace rsphere
