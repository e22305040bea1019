#include "importance/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "image/picture_file.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

constexpr double kPi = std::numbers::pi;

// What the sRGB curve makes .5.
constexpr double kMidBright = .21404114;

double sRgb(double x) {
  return x <= .0031308 ? 12.92 * x : 1.055 * std::pow(std::min(x, 1.), 1 / 2.4) - .055;
}

// Where pixels lie on the sphere. Edges between pixels are whole numbers.
struct PixelMap {
  int width, height;
  double polar(double y) const { return kPi * y / height; }
  double azimuth(double x) const { return 2 * kPi * x / width; }
  V3d direction(double x, double y) const {
    const double sine = std::sin(polar(y));
    return V3d(sine * std::cos(azimuth(x)), sine * std::sin(azimuth(x)), std::cos(polar(y)));
  }
  int column(double azimuth) const {
    const auto x = static_cast<int>(std::floor(azimuth / (2 * kPi) * width));
    return ((x % width) + width) % width;
  }
  int row(double polar) const {
    return std::clamp(static_cast<int>(std::floor(polar / kPi * height)), 0, height - 1);
  }
};

// The nearest of some directions to each pixel. From the whole picture down to pixels, each rectangle keeps
// the directions that may be the nearest to one of its pixels: those not farther from its middle than the
// nearest one by more than its width (the triangle inequality, of chords). A rectangle that has one left is
// done.
class NearestMap {
 public:
  NearestMap(const PixelMap& map, std::span<const V3d> directions)
      : map_(map), directions_(directions), nearest_(static_cast<size_t>(map.width) * map.height) {
    candidates_.resize(directions.size());
    for (size_t i = 0; i < directions.size(); ++i) candidates_[i] = static_cast<uint32_t>(i);
    if (!directions.empty()) fill(0, 0, map.width, map.height, 0);
  }
  uint32_t at(size_t pixel) const { return nearest_[pixel]; }

 private:
  // Candidates are those from `begin` on; they are left as they were.
  void fill(int x0, int y0, int x1, int y1, size_t begin) {
    const size_t end = candidates_.size();
    const double x = .5 * (x0 + x1), y = .5 * (y0 + y1);
    const V3d middle = map_.direction(x, y);
    // From the middle along its parallel, then along a meridian to the farthest pixel's middle.
    const double radius =
        map_.azimuth(.5 * (x1 - x0 - 1)) * std::sin(map_.polar(y)) + map_.polar(.5 * (y1 - y0 - 1)) + 1e-12;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = begin; i < end; ++i)
      least = std::min(least, (directions_[candidates_[i]] - middle).length2());
    const double farthest = std::sqrt(least) + 2 * radius;
    for (size_t i = begin; i < end; ++i) {
      const uint32_t candidate = candidates_[i];
      if ((directions_[candidate] - middle).length2() <= farthest * farthest)
        candidates_.push_back(candidate);
    }
    if (candidates_.size() == end + 1 || (x1 - x0 == 1 && y1 - y0 == 1)) {
      for (int row = y0; row < y1; ++row)
        std::fill(nearest_.begin() + static_cast<ptrdiff_t>(row) * map_.width + x0,
                  nearest_.begin() + static_cast<ptrdiff_t>(row) * map_.width + x1, nearestOf(middle, end));
    } else if (x1 - x0 > y1 - y0) {
      fill(x0, y0, (x0 + x1) / 2, y1, end);
      fill((x0 + x1) / 2, y0, x1, y1, end);
    } else {
      fill(x0, y0, x1, (y0 + y1) / 2, end);
      fill(x0, (y0 + y1) / 2, x1, y1, end);
    }
    candidates_.resize(end);
  }

  uint32_t nearestOf(const V3d& to, size_t begin) const {
    return *std::min_element(candidates_.begin() + static_cast<ptrdiff_t>(begin), candidates_.end(),
                             [&](uint32_t a, uint32_t b) {
                               return (directions_[a] - to).length2() < (directions_[b] - to).length2();
                             });
  }

  const PixelMap& map_;
  std::span<const V3d> directions_;
  std::vector<uint32_t> nearest_, candidates_;
};

// Calls paint(pixel, squared chord) for the pixels in the cap, and for the one that holds its middle.
template <class Paint>
void forEachInCap(const PixelMap& map, const V3d& axis, double solidAngle, const Paint& paint) {
  const double versine = std::min(solidAngle / (2 * kPi), 2.), halfAngle = std::acos(1 - versine);
  const double polar = std::acos(std::clamp(axis.z, -1., 1.)), azimuth = std::atan2(axis.y, axis.x);
  const int middleRow = map.row(polar);
  paint(static_cast<size_t>(middleRow) * map.width + map.column(azimuth), 0.);
  const bool holdsPole = polar - halfAngle <= 0 || polar + halfAngle >= kPi;
  const double across = holdsPole ? kPi : std::asin(std::min(1., std::sin(halfAngle) / std::sin(polar)));
  const int columns = std::min(map.width, static_cast<int>(across / kPi * map.width) + 3);
  const int first = map.column(azimuth - across);
  for (int row = map.row(polar - halfAngle); row <= map.row(polar + halfAngle); ++row)
    for (int i = 0; i < columns; ++i) {
      const int column = (first + i) % map.width;
      const double chord = (map.direction(column + .5, row + .5) - axis).length2();
      if (chord <= 2 * versine) paint(static_cast<size_t>(row) * map.width + column, chord);
    }
}

// What an integer format shows of the radiances.
void expose(std::vector<float>& pixels, std::span<const DirectionSample> samples) {
  double sum = 0, solidAngle = 0;
  for (const DirectionSample& s : samples) {
    sum += s.solidAngle * brightness(s.value);
    solidAngle += s.solidAngle;
  }
  const double exposure = sum > 0 ? kMidBright / (2 * sum / solidAngle) : 1;
  for (float& p : pixels) p = static_cast<float>(sRgb(std::max(0., exposure * p)));
}

}  // namespace

DistributionPicture drawDistribution(std::span<const DirectionSample> samples, int width, int height) {
  DistributionPicture picture{width, height, std::vector<float>(size_t{3} * width * height)};
  const PixelMap map{width, height};
  const auto setPixel = [&](size_t pixel, const Rgb& value) {
    for (size_t channel = 0; channel < 3; ++channel)
      picture.pixels[3 * pixel + channel] = static_cast<float>(value[static_cast<int>(channel)]);
  };
  std::vector<V3d> directions;
  std::vector<uint32_t> sampleOf;
  for (uint32_t i = 0; i < samples.size(); ++i) {
    if (samples[i].toSource || !(samples[i].solidAngle > 0)) continue;
    directions.push_back(samples[i].direction);
    sampleOf.push_back(i);
  }
  if (!directions.empty()) {
    const NearestMap nearest(map, directions);
    for (size_t pixel = 0; pixel < picture.pixels.size() / 3; ++pixel)
      setPixel(pixel, samples[sampleOf[nearest.at(pixel)]].value);
  }
  std::vector<double> chords(picture.pixels.size() / 3, std::numeric_limits<double>::infinity());
  for (const DirectionSample& s : samples) {
    if (!s.toSource || !(s.solidAngle > 0)) continue;
    forEachInCap(map, s.direction, s.solidAngle, [&](size_t pixel, double chord) {
      if (chord >= chords[pixel]) return;
      chords[pixel] = chord;
      setPixel(pixel, s.value);
    });
  }
  return picture;
}

std::string pictureName(const std::string& pattern, uint64_t record) {
  std::string name;
  bool numbered = false;
  for (size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      name += pattern[i];
      continue;
    }
    const size_t end = pattern.find_first_not_of("0123456789", i + 1);
    const size_t digits = end == std::string::npos ? 0 : end - i - 1;
    if (end == i + 1 && pattern[end] == '%') {
      name += '%';
    } else if (end != std::string::npos && digits <= 3 && pattern[end] == 'd' && !numbered) {
      const bool zeros = digits > 0 && pattern[i + 1] == '0';
      const size_t width = digits > 0 ? std::stoul(pattern.substr(i + 1, digits)) : 0;
      const std::string number = std::to_string(record);
      name.append(width > number.size() ? width - number.size() : 0, zeros ? '0' : ' ');
      name += number;
      numbered = true;
    } else {
      throw rad::Error(fmt::format("picture \"{}\": % stands for one %d, %4d or %04d, or %%", pattern));
    }
    i = end;
  }
  if (!numbered && record > 0)
    throw rad::Error(fmt::format("picture \"{}\": no %d in it for record {}", pattern, record));
  return name;
}

void writeDistribution(const std::string& pattern, uint64_t record,
                       std::span<const DirectionSample> samples) {
  if (pattern.empty()) return;
  const std::string name = pictureName(pattern, record);
  PictureFile file(name);
  DistributionPicture picture = drawDistribution(samples);
  if (file.format() == PictureFormat::screen) expose(picture.pixels, samples);
  file.write({picture.width, picture.height, std::move(picture.pixels)}, "#?RADIANCE\n");
}

}  // namespace rsphere
