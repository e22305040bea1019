#include "image/radiance_picture.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <span>

#include "image/rgbe.h"

namespace rsphere {
namespace {

// The format's run-length code: a count up to 128 is followed by that number of bytes; a larger count by a
// single byte, which is repeated count - 128 times.
constexpr size_t kMostLiteral = 128, kLongestRun = 127;
// A run takes two bytes. Shorter runs save nothing, because they split the surrounding sequence of bytes.
constexpr size_t kShortestRun = 4;
constexpr int kLeastCodedWidth = 8, kMostCodedWidth = 32767;

size_t runAt(std::span<const uint8_t> bytes, size_t at) {
  size_t end = at + 1;
  while (end < bytes.size() && end - at < kLongestRun && bytes[end] == bytes[at]) ++end;
  return end - at;
}

void appendRuns(std::string& out, std::span<const uint8_t> bytes) {
  for (size_t at = 0; at < bytes.size();) {
    if (const size_t run = runAt(bytes, at); run >= kShortestRun) {
      out += static_cast<char>(kMostLiteral + run);
      out += static_cast<char>(bytes[at]);
      at += run;
      continue;
    }
    size_t end = at + 1;
    while (end < bytes.size() && end - at < kMostLiteral && runAt(bytes, end) < kShortestRun) ++end;
    out += static_cast<char>(end - at);
    out.append(reinterpret_cast<const char*>(bytes.data() + at), end - at);
    at = end;
  }
}

}  // namespace

std::string radiancePicture(const Raster& raster, std::string_view header) {
  std::string out(header);
  out += fmt::format("FORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", raster.height, raster.width);
  const bool coded = raster.width >= kLeastCodedWidth && raster.width <= kMostCodedWidth;
  const auto width = static_cast<size_t>(raster.width);
  std::array<std::vector<uint8_t>, 4> scanline;
  for (auto& channel : scanline) channel.resize(width);
  for (int row = 0; row < raster.height; ++row) {
    const float* pixels = raster.pixels.data() + 3 * width * static_cast<size_t>(row);
    for (size_t x = 0; x < width; ++x) {
      const auto pixel = rgbePixel(Color(pixels[3 * x], pixels[3 * x + 1], pixels[3 * x + 2]));
      for (size_t c = 0; c < 4; ++c) scanline[c][x] = pixel[c];
      if (!coded) out.append(reinterpret_cast<const char*>(pixel.data()), pixel.size());
    }
    if (!coded) continue;
    out += "\2\2";
    out += static_cast<char>(width >> 8);
    out += static_cast<char>(width & 255);
    for (const auto& channel : scanline) appendRuns(out, channel);
  }
  return out;
}

}  // namespace rsphere
