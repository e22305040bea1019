#include "importance/point_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/colorimetry.h"
#include "image/screen_color.h"
#include "importance/smooth_indirect.h"
#include "importance/tuning.h"
#include "rad_parser/error.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

using std::numbers::pi;
using Tuning = tuning::Pictures;

V3d valueAt(const Raster& raster, size_t pixel) {
  const float* p = raster.pixels.data() + 3 * pixel;
  return V3d(p[0], p[1], p[2]);
}

void setValue(Raster& raster, size_t pixel, const V3d& value) {
  for (int c = 0; c < 3; ++c)
    raster.pixels[3 * pixel + static_cast<size_t>(c)] = static_cast<float>(value[c]);
}

// The seeds of a picture, each named after its use.
class PictureStreams {
 public:
  explicit PictureStreams(uint64_t seed) : seed_(seed) {}
  uint64_t smallSources() const { return mixBits(seed_ + 1); }
  uint64_t middle(size_t pixel) const { return mixBits(seed_ + 16 + pixel); }
  // beside: index in Tuning::kBeside.
  uint64_t aside(size_t pixel, size_t beside) const { return mixBits(middle(pixel) + 1 + beside); }

 private:
  uint64_t seed_;
};

// The light of small sources in one pixel.
struct Spot {
  double solidAngle = 0;
  Irradiance light;
};

}  // namespace

std::optional<V3d> PixelMap::direction(double x, double y) const {
  if (projection_ == Projection::latitudeLongitude) {
    const double polar = pi * y / height_, azimuth = 2 * pi * x / width_, sine = std::sin(polar);
    return V3d(sine * std::cos(azimuth), sine * std::sin(azimuth), std::cos(polar));
  }
  const double right = 2 * x / width_ - 1, up = 1 - 2 * y / height_, radius = std::hypot(right, up);
  if (radius > 1) return std::nullopt;
  const double sine = std::sin(pi * radius), scale = radius > 0 ? sine / radius : 0;
  return V3d(right * scale, std::cos(pi * radius), up * scale);
}

size_t PixelMap::pixelOf(const V3d& d) const {
  double x = 0, y = 0;
  if (projection_ == Projection::latitudeLongitude) {
    const double azimuth = std::atan2(d.y, d.x);
    x = (azimuth < 0 ? azimuth + 2 * pi : azimuth) / (2 * pi) * width_;
    y = std::acos(std::clamp(d.z, -1., 1.)) / pi * height_;
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
  const double radius = std::hypot(2 * (column + .5) / width_ - 1, 2 * (row + .5) / height_ - 1);
  if (radius > 1) return 0;
  const double square = 2 * pi / width_ * (2 * pi / height_);
  return radius > 0 ? square * std::sin(pi * radius) / (pi * radius) : square;
}

namespace {

// The sources that pixels may miss: their images, and their light in each pixel.
struct SmallSources {
  std::vector<SeenSources::Image> images;
  std::map<size_t, Spot> spots;  // by pixel
};

SmallSources smallSources(const V3d& point, const PixelMap& map, const SeenSources& sources,
                          PathTracer& tracer, uint64_t seed) {
  SmallSources small{sources.findImages(point, map.count(), 0), {}};
  // Pixels are smaller near the rim and the poles.
  for (SeenSources::Image& image : small.images) {
    const double there = map.solidAngle(map.pixelOf(image.region.sample(.5, .5)));
    const double pixels = there > 0 ? image.solidAngle / there : Tuning::kSmallest;
    image.rays =
        pixels < Tuning::kSmallest ? std::max(Tuning::kLeastSamples, Tuning::kSamplesPerPixel * pixels) : 0;
  }
  small.images.erase(std::remove_if(small.images.begin(), small.images.end(),
                                    [](const auto& image) { return image.rays == 0; }),
                     small.images.end());
  for (const SeenSources::Sample& s : sources.sample(point, small.images, seed, tracer)) {
    if (!(s.direction.solidAngle > 0)) continue;
    Spot& spot = small.spots[map.pixelOf(s.direction.direction)];
    spot.solidAngle += s.direction.solidAngle;
    spot.light += irradianceFrom(s.direction.value, s.direction.solidAngle);
  }
  return small;
}

// Traces pixels, and separates the indirect light of the surface that is seen from all other light.
class PixelTracer {
 public:
  PixelTracer(const V3d& point, const Transport& transport, PathTracer& tracer)
      : point_(point), transport_(transport), tracer_(tracer) {
    tracer_.guessWith(nullptr);
    tracer_.useCoarseSolutionAtFirst(false);
    tracer_.observe([this](const Ray& ray) {
      if (ray.depth == 1 && (ray.kind & kAmbient)) indirect_ += ray.value * ray.contribution;
    });
  }
  ~PixelTracer() { tracer_.observe(nullptr); }
  PixelTracer(const PixelTracer&) = delete;
  PixelTracer& operator=(const PixelTracer&) = delete;

  // Returns the radiance (red, green, blue) without the indirect light that it stores in pixel.light, which is to be
  // multiplied by `pattern` and added.
  V3d trace(const V3d& direction, uint64_t seed, IndirectPixels::Pixel& pixel, V3d& pattern) {
    indirect_ = {};
    pixel = {};
    const Ray ray = tracer_.trace(point_, direction, 0, seed);
    const Hit& hit = tracer_.firstHit();
    const SpectralSampling* const sampling = transport_.options().sampling;
    pattern = shownRgb(ray.pattern, sampling);
    // The indirect light is not separated if a medium attenuates it on its way, or if the pattern is
    // black in a channel and it cannot be divided by the pattern.
    if (hit.surface == kNone || !isBlack(transport_.medium().extinction) ||
        !transport_.scatterers().empty() || !(std::min({pattern.x, pattern.y, pattern.z}) > 0))
      return shownRgb(ray.value.color, sampling);
    const Scene& scene = transport_.scene();
    const ModifierId material = scene.surfaces[hit.surface].material;
    if (!scene.materialAt(material)) return shownRgb(ray.value.color, sampling);
    pixel.material = material;
    pixel.light = Imath::V3f(shownRgb(indirect_.color, sampling) / pattern);
    pixel.point = Imath::V3f(hit.distance * direction);
    pixel.normal = Imath::V3f(hit.normal);
    pixel.distance = static_cast<float>(hit.distance);
    return shownRgb((ray.value - indirect_).color, sampling);
  }

 private:
  const V3d& point_;
  const Transport& transport_;
  PathTracer& tracer_;
  Radiance indirect_;
};

}  // namespace

Raster drawPoint(const V3d& point, const PixelMap& map, const Transport& transport,
                 const SeenSources& sources, PathTracer& tracer, uint64_t seed,
                 const std::function<void()>& checkStop) {
  const PictureStreams streams(seed);
  const SmallSources small = smallSources(point, map, sources, tracer, streams.smallSources());
  std::vector<V3d> direct(map.count(), V3d(0, 0, 0));
  std::vector<V3d> patterns(map.count(), V3d(1, 1, 1));
  IndirectPixels indirect{map.width(), map.height(), map.wraps(), {}};
  indirect.pixels.resize(map.count());
  PixelTracer pixels(point, transport, tracer);
  for (int row = 0; row < map.height(); ++row) {
    if (checkStop) checkStop();
    for (int column = 0; column < map.width(); ++column) {
      const size_t pixel =
          static_cast<size_t>(row) * static_cast<size_t>(map.width()) + static_cast<size_t>(column);
      const auto trace = [&](double x, double y, uint64_t raySeed) {
        const auto direction = map.direction(column + x, row + y);
        direct[pixel] = V3d(0, 0, 0);
        indirect.pixels[pixel] = {};
        if (!direction) return true;
        direct[pixel] = pixels.trace(*direction, raySeed, indirect.pixels[pixel], patterns[pixel]);
        return small.images.empty() || !sources.shownStraight(tracer, small.images);
      };
      bool shown = !trace(.5, .5, streams.middle(pixel));
      for (size_t i = 0; shown && i < Tuning::kBeside.size(); ++i)
        shown = !trace(.5 + Tuning::kBeside[i][0], .5 + Tuning::kBeside[i][1], streams.aside(pixel, i));
      if (shown) direct[pixel] = V3d(0, 0, 0);
    }
  }
  smoothIndirect(indirect);
  Raster raster{map.width(), map.height(), std::vector<float>(3 * map.count())};
  for (size_t pixel = 0; pixel < map.count(); ++pixel) {
    const Imath::V3f& light = indirect.pixels[pixel].light;
    setValue(raster, pixel, direct[pixel] + patterns[pixel] * V3d(light));
  }
  for (const auto& [pixel, spot] : small.spots) {
    const double whole = std::max(map.solidAngle(pixel), spot.solidAngle);
    setValue(raster, pixel,
             valueAt(raster, pixel) * (1 - spot.solidAngle / whole) +
                 shownRgb(meanRadiance(spot.light, whole).color, transport.options().sampling));
  }
  return raster;
}

void expose(Raster& raster, const PixelMap& map) {
  std::vector<std::pair<double, double>> lit;  // brightness, solid angle
  double all = 0;
  for (size_t pixel = 0; pixel < map.count(); ++pixel) {
    const double b = brightness(Color(valueAt(raster, pixel))), solidAngle = map.solidAngle(pixel);
    if (!(b > 0) || !(solidAngle > 0)) continue;
    lit.emplace_back(b, solidAngle);
    all += solidAngle;
  }
  std::sort(lit.begin(), lit.end());
  double median = 0;
  for (double sum = 0; const auto& [b, solidAngle] : lit) {
    median = b;
    if ((sum += solidAngle) >= all / 2) break;
  }
  const double exposure = median > 0 ? kMidBright / median : 1;
  for (float& p : raster.pixels) p = static_cast<float>(sRgb(std::max(0., exposure * p)));
}

std::string viewLine(const V3d& p) {
  return fmt::format("VIEW= -vta -vp {} {} {} -vd 0 1 0 -vu 0 0 1 -vh 360 -vv 360 -vo 0 -va 0 -vs 0 -vl 0\n",
                     p.x, p.y, p.z);
}

namespace {

// The pattern with a %d before its suffix.
std::string withNumber(std::string pattern) {
  const size_t folder = pattern.rfind('/') + 1, dot = pattern.rfind('.');
  return pattern.insert(dot == std::string::npos || dot < folder ? pattern.size() : dot, "%d");
}

}  // namespace

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
