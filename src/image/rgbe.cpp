#include "image/rgbe.h"

#include <cmath>

namespace rsphere {

std::array<uint8_t, 4> rgbePixel(const Color& c) {
  const auto red = static_cast<float>(c.x), green = static_cast<float>(c.y), blue = static_cast<float>(c.z);
  const float largest = std::fmax(red, std::fmax(green, blue));
  if (!(largest > 1e-32)) return {0, 0, 0, 0};
  int exponent = 0;
  std::frexp(largest, &exponent);
  constexpr int kExcess = 128;
  if (!std::isfinite(largest) || exponent + kExcess > 255) return {255, 255, 255, 255};
  const auto mantissa = [exponent](float x) {
    return x > 0 ? static_cast<uint8_t>(std::ldexp(static_cast<double>(x), 8 - exponent)) : uint8_t{0};
  };
  return {mantissa(red), mantissa(green), mantissa(blue), static_cast<uint8_t>(exponent + kExcess)};
}

}  // namespace rsphere
