#include "pictures/point_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "image/picture_formats.h"
#include "pictures/tuning.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

using std::numbers::pi;

// The angle from +y to the heading, in radians; 0 exactly where they are equal.
double turnOf(double heading) { return (heading - 90) * (pi / 180); }

// Inserts %d before the suffix of the pattern.
std::string withNumber(std::string pattern) {
  const size_t folder = pattern.rfind('/') + 1, dot = pattern.rfind('.');
  return pattern.insert(dot == std::string::npos || dot < folder ? pattern.size() : dot, "%d");
}

}  // namespace

PixelMap::PixelMap(Projection projection, const PictureForm& form)
    : projection_(projection),
      cosine_(std::cos(turnOf(form.heading))),
      sine_(std::sin(turnOf(form.heading))) {
  const bool fisheye = projection == Projection::angularFisheye;
  const bool perspective = projection == Projection::perspective;
  width_ = form.width > 0 ? form.width : fisheye ? tuning::Pictures::kFisheyeSide : 1024;
  height_ = fisheye ? width_ : std::max(1, perspective ? width_ * 3 / 4 : width_ / 2);
  if (perspective) right_ = std::tan(form.viewAngle * (pi / 360));
  up_ = right_ * height_ / width_;
}

std::optional<V3d> PixelMap::direction(double x, double y) const {
  const auto turned = [this](double right, double forward, double up) {
    return V3d(cosine_ * right - sine_ * forward, sine_ * right + cosine_ * forward, up);
  };
  if (projection_ == Projection::latitudeLongitude) {
    const double polar = pi * y / height_, right = 2 * pi * (x / width_ - .5), sine = std::sin(polar);
    return turned(sine * std::sin(right), sine * std::cos(right), std::cos(polar));
  }
  const double right = 2 * x / width_ - 1, up = 1 - 2 * y / height_, radius = std::hypot(right, up);
  if (projection_ == Projection::perspective) return turned(right_ * right, 1, up_ * up).normalized();
  if (radius > 1) return std::nullopt;
  const double sine = std::sin(pi * radius), scale = radius > 0 ? sine / radius : 0;
  return turned(right * scale, std::cos(pi * radius), up * scale);
}

std::optional<size_t> PixelMap::pixelOf(const V3d& world) const {
  const V3d d(cosine_ * world.x + sine_ * world.y, cosine_ * world.y - sine_ * world.x, world.z);
  double x = 0, y = 0;
  if (projection_ == Projection::latitudeLongitude) {
    x = (.5 + std::atan2(d.x, d.y) / (2 * pi)) * width_;
    y = std::acos(std::clamp(d.z, -1., 1.)) / pi * height_;
  } else if (projection_ == Projection::perspective) {
    if (!(std::abs(d.x) <= right_ * d.y && std::abs(d.z) <= up_ * d.y)) return std::nullopt;
    x = (1 + d.x / (right_ * d.y)) / 2 * width_;
    y = (1 - d.z / (up_ * d.y)) / 2 * height_;
  } else {
    const double sine = std::hypot(d.x, d.z), radius = std::atan2(sine, d.y) / pi;
    const double scale = sine > 0 ? radius / sine : 0;
    x = (1 + d.x * scale) / 2 * width_;
    y = (1 - d.z * scale) / 2 * height_;
  }
  const int column = std::clamp(static_cast<int>(x), 0, width_ - 1),
            row = std::clamp(static_cast<int>(y), 0, height_ - 1);
  return static_cast<size_t>(row) * static_cast<size_t>(width_) + static_cast<size_t>(column);
}

double PixelMap::solidAngle(size_t pixel) const {
  const auto row = static_cast<double>(pixel / static_cast<size_t>(width_)),
             column = static_cast<double>(pixel % static_cast<size_t>(width_));
  if (projection_ == Projection::latitudeLongitude)
    return 2 * pi / width_ * (std::cos(pi * row / height_) - std::cos(pi * (row + 1) / height_));
  const double right = 2 * (column + .5) / width_ - 1, up = 2 * (row + .5) / height_ - 1;
  if (projection_ == Projection::perspective) {
    const double distance = V3d(right_ * right, 1, up_ * up).length();
    return 4 * right_ * up_ / static_cast<double>(count()) / (distance * distance * distance);
  }
  const double radius = std::hypot(right, up);
  if (radius > 1) return 0;
  const double square = 2 * pi / width_ * (2 * pi / height_);
  return radius > 0 ? square * std::sin(pi * radius) / (pi * radius) : square;
}

std::string PixelMap::viewLine(const V3d& p) const {
  const auto rounded = [](double x) { return std::round(x * 1e9) / 1e9 + 0.; };  // + 0.: not -0
  const bool perspective = projection_ == Projection::perspective;
  const auto angle = [&](double reach) { return perspective ? rounded(std::atan(reach) * 360 / pi) : 360; };
  return fmt::format("VIEW= -vt{} -vp {} {} {} -vd {} {} 0 -vu 0 0 1 -vh {} -vv {} -vo 0 -va 0 -vs 0 -vl 0\n",
                     perspective ? 'v' : 'a', p.x, p.y, p.z, rounded(-sine_), rounded(cosine_), angle(right_),
                     angle(up_));
}

ToneCurve::ToneCurve(const Raster& raster, const PixelMap& map, double white)
    : exposure_(white > 0 ? 1 / white : 0) {
  if (white > 0) return;
  std::vector<std::pair<double, double>> lit;  // brightness, solid angle
  double all = 0;
  for (size_t pixel = 0; pixel < map.count(); ++pixel) {
    const double b = brightness(Color(valueAt(raster, pixel))), solidAngle = map.solidAngle(pixel);
    if (!(b > 0) || !(solidAngle > 0)) continue;
    lit.emplace_back(b, solidAngle);
    all += solidAngle;
  }
  std::ranges::sort(lit);
  double median = 0;
  for (double sum = 0; const auto& [b, solidAngle] : lit) {
    median = b;
    if ((sum += solidAngle) >= all / 2) break;
  }
  // The operator, without a bound, shows an exposed brightness L as L / (1 + L).
  exposure_ = median > 0 ? kMidBright / (1 - kMidBright) / median : 1;
  white_ = std::max(tuning::Pictures::kLeastWhite, median > 0 ? exposure_ * lit.back().first : 0);
}

V3d ToneCurve::shown(const V3d& radiance) const {
  double factor = exposure_;
  if (white_ > 0) {
    const double exposed = std::max(0., exposure_ * brightness(Color(radiance)));
    factor *= (1 + exposed / (white_ * white_)) / (1 + exposed);
  }
  V3d shown = factor * radiance;
  for (int c = 0; c < 3; ++c) shown[c] = std::clamp(shown[c], 0., 1.);
  return shown;
}

V3d ToneCurve::radiance(const V3d& shown) const {
  double factor = 1 / exposure_;
  if (white_ > 0) {
    // The solution L of b = L (1 + L / white^2) / (1 + L), divided by b.
    const double b = brightness(Color(shown)), rest = std::max(0., 1 - b);
    factor *= 2 / (rest + std::sqrt(rest * rest + 4 * b / (white_ * white_)));
  }
  return factor * shown;
}

void toScreen(Raster& raster, const ToneCurve& curve) {
  for (size_t pixel = 0; pixel < raster.pixels.size() / 3; ++pixel) {
    V3d color = curve.shown(valueAt(raster, pixel));
    for (int c = 0; c < 3; ++c) color[c] = sRgb(color[c]);
    setValue(raster, pixel, color);
  }
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
    throw rad::Error(
        fmt::format("picture \"{}\": its name needs a %d for the number of record {}, as in \"{}\"", pattern,
                    record, withNumber(pattern)));
  return name;
}

}  // namespace rsphere
