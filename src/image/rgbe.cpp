#include "image/rgbe.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

// pixel: one byte for each value, then one for the exponent.
void setPixel(std::span<const double> values, std::span<uint8_t> pixel) {
  std::ranges::fill(pixel, uint8_t{0});
  float largest = 0;
  for (const double value : values) largest = std::fmax(largest, static_cast<float>(value));
  if (!(largest > 1e-32)) return;
  int exponent = 0;
  std::frexp(largest, &exponent);
  constexpr int kExcess = 128;
  if (!std::isfinite(largest) || exponent + kExcess > 255)
    return std::fill(pixel.begin(), pixel.end(), uint8_t{255});
  for (size_t i = 0; i < values.size(); ++i)
    if (const auto x = static_cast<float>(values[i]); x > 0)
      pixel[i] = static_cast<uint8_t>(std::ldexp(static_cast<double>(x), 8 - exponent));
  pixel.back() = static_cast<uint8_t>(exponent + kExcess);
}

}  // namespace

std::array<uint8_t, 4> rgbePixel(const Color& c) {
  std::array<uint8_t, 4> pixel{};
  setPixel(std::array{c.x, c.y, c.z}, pixel);
  return pixel;
}

void appendSpectralPixel(std::span<const double> bands, std::string& bytes) {
  const size_t before = bytes.size();
  bytes.resize(before + bands.size() + 1);
  setPixel(bands, std::span(reinterpret_cast<uint8_t*>(bytes.data()) + before, bands.size() + 1));
}

}  // namespace rsphere
