// A picture of the radiance that arrives at a point from all directions, from what rsphere -Sd prints:
//   rsphere -h- -Sd -oidwv scene.rad < points.txt | distribution RECORD picture.png
//
// Latitude-longitude: zenith along the top edge, nadir along the bottom one, +x in the middle, +y a quarter
// of the width to its left, as one sees it who stands at the point. Each pixel is the radiance of the
// direction nearest to it, which is its Voronoi cell.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "image/picture_file.h"
#include "sphere/directions.h"

namespace {

using rsphere::V3d;

constexpr int kWidth = 720, kHeight = 360;  // half a degree a pixel: a cell of 2048 is 4.5 degrees wide
constexpr double kPi = std::numbers::pi;

struct Sample {
  V3d direction, radiance;
};

double luminance(const V3d& rgb) { return .265 * rgb.x + .67 * rgb.y + .065 * rgb.z; }

// The samples of one record. Lines: record, direction (3), solid angle, radiance (3).
std::vector<Sample> readSamples(std::istream& in, double wanted) {
  std::vector<Sample> samples;
  double record = 0, solidAngle = 0;
  Sample s;
  while (in >> record >> s.direction.x >> s.direction.y >> s.direction.z >> solidAngle >> s.radiance.x >>
         s.radiance.y >> s.radiance.z) {
    // Directions in which a light source was found that is integrated by itself have none.
    if (record == wanted && solidAngle > 0) samples.push_back(s);
  }
  if (!in.eof()) throw std::runtime_error("standard input is not what rsphere -h- -Sd -oidwv prints");
  if (samples.empty()) throw std::runtime_error(fmt::format("no directions of record {}", wanted));
  return samples;
}

V3d pixelDirection(int x, int y) {
  const double azimuth = kPi - 2 * kPi * (x + .5) / kWidth, polar = kPi * (y + .5) / kHeight;
  return V3d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
}

// The decades of luminance below the brightest that are told apart.
constexpr double kDecades = 4;

// Luminance in false color: a lamp and the faintest of the light that it makes are seen in one picture. Even
// steps of the logarithm are even steps from black by violet, red and yellow to white; without light is
// black.
class FalseColor {
 public:
  explicit FalseColor(const std::vector<Sample>& samples) {
    for (const Sample& s : samples) brightest_ = std::max(brightest_, luminance(s.radiance));
  }
  double brightest() const { return brightest_; }

  // From 0 to 1.
  void append(const V3d& radiance, std::vector<float>& rgb) const {
    const double y = luminance(radiance);
    const double shown = y > 0 ? std::clamp(1 + std::log10(y / brightest_) / kDecades, 0., 1.) : 0;
    const double at = shown * (kSteps.size() - 1);
    const size_t below = std::min(static_cast<size_t>(at), kSteps.size() - 2);
    const V3d color = kSteps[below] + (kSteps[below + 1] - kSteps[below]) * (at - static_cast<double>(below));
    for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(color[c] / 255));
  }

 private:
  // Each about as much lighter than the one before, also for the color blind.
  static inline const std::array<V3d, 8> kSteps = {V3d(0, 0, 0),      V3d(45, 15, 95),   V3d(105, 25, 115),
                                                   V3d(165, 45, 95),  V3d(220, 80, 55),  V3d(248, 140, 20),
                                                   V3d(250, 205, 70), V3d(255, 255, 255)};
  double brightest_ = 0;
};

rsphere::Raster draw(const std::vector<Sample>& samples, const FalseColor& colors) {
  rsphere::Raster raster{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const V3d direction = pixelDirection(x, y);
      const auto nearer = [&](const Sample& a, const Sample& b) {
        return a.direction.dot(direction) < b.direction.dot(direction);
      };
      colors.append(std::max_element(samples.begin(), samples.end(), nearer)->radiance, raster.pixels);
    }
  }
  return raster;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned record = 0;
  const std::string_view word = argc == 3 ? argv[1] : "";
  if (word.empty() || std::from_chars(word.begin(), word.end(), record).ptr != word.end()) {
    std::cerr << "usage: rsphere -h- -Sd -oidwv scene... < points | " << argv[0] << " RECORD picture.png\n";
    return 1;
  }
  try {
    const std::vector<Sample> samples = readSamples(std::cin, record);
    const FalseColor colors(samples);
    rsphere::PictureFile(argv[2]).write(draw(samples, colors), "");
    fmt::print("{}: {} directions; white is {:.0f} cd/m2, black 1/10,000 of it or less\n", argv[2],
               samples.size(), 179 * colors.brightest());
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}
