#include "importance/draw_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "base/colorimetry.h"
#include "image/screen_color.h"
#include "importance/pixel_tracer.h"
#include "importance/tuning.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

using Tuning = tuning::Pictures;

constexpr Smoothing kOfIndirect{Tuning::kIndirectPasses, Tuning::kCarefulPasses, Tuning::kSameLight,
                                Tuning::kSameNormal,     Tuning::kSamePlane,     Tuning::kNear};
constexpr Smoothing kOfGloss{Tuning::kGlossPasses, 0, 0, Tuning::kSameGlossNormal, Tuning::kSamePlane,
                             Tuning::kNear};

constexpr double kTracingShare = .8;  // of the time of a picture; for progress reports only

// The seeds of a picture, each named after its use.
class PictureStreams {
 public:
  explicit PictureStreams(uint64_t seed) : seed_(seed) {}
  uint64_t smallSources() const { return mixBits(seed_ + 1); }
  uint64_t middle(size_t pixel) const { return mixBits(seed_ + 16 + pixel); }
  // beside: index in Tuning::kBeside.
  uint64_t aside(size_t pixel, size_t beside) const { return mixBits(middle(pixel) + 1 + beside); }
  // part: of the kSide x kSide parts of a pixel.
  uint64_t part(size_t pixel, size_t part) const { return mixBits(middle(pixel) + 64 + part); }

 private:
  uint64_t seed_;
};

// The light of small sources in one pixel.
struct Spot {
  double solidAngle = 0;
  Irradiance light;
};

// The sources that pixels may miss: their images, and their light in each pixel.
struct SmallSources {
  std::vector<SeenSources::Image> images;
  std::map<size_t, Spot> spots;  // by pixel
};

SmallSources smallSources(const PathsFrom& paths, const PixelMap& map, const SeenSources& sources,
                          uint64_t seed) {
  SmallSources small{sources.findImages(paths.point(), map.count(), 0), {}};
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
  for (const SeenSources::Sample& s : sources.sample(paths, small.images, seed)) {
    if (!(s.direction.solidAngle > 0)) continue;
    Spot& spot = small.spots[map.pixelOf(s.direction.direction)];
    spot.solidAngle += s.direction.solidAngle;
    spot.light += irradianceFrom(s.direction.value, s.direction.solidAngle);
  }
  return small;
}

// All pixels of a picture, by component.
struct Pixels {
  SeenSurfaces seen;
  PixelLight indirect, gloss;
  std::vector<V3d> rest, pattern;
  std::vector<bool> sharesGloss;

  explicit Pixels(const PixelMap& map) : seen{map.width(), map.height(), map.wraps(), {}} {
    seen.pixels.resize(map.count());
    for (PixelLight* component : {&indirect, &gloss}) {
      component->light.assign(map.count(), Imath::V3f(0, 0, 0));
      component->known.assign(map.count(), 0);
    }
    rest.assign(map.count(), V3d(0, 0, 0));
    pattern.assign(map.count(), V3d(1, 1, 1));
    sharesGloss.assign(map.count(), false);
  }
  void set(size_t pixel, const PixelSample& sample, bool hasIndirect) {
    seen.pixels[pixel] = sample.seen;
    indirect.light[pixel] = Imath::V3f(sample.indirect);
    indirect.known[pixel] = hasIndirect ? 1 : 0;
    gloss.light[pixel] = Imath::V3f(sample.gloss);
    gloss.known[pixel] = sample.sharesGloss ? 1 : 0;
    rest[pixel] = sample.rest;
    pattern[pixel] = sample.pattern;
    sharesGloss[pixel] = sample.sharesGloss;
  }
  // A sample of a pixel's surface, with the components of this pixel where it lacks them.
  V3d complete(const PixelSample& sample, size_t pixel) const {
    V3d value = sample.rest;
    if (sample.seen.material != kNone) value += sample.pattern * V3d(indirect.light[pixel]);
    if (sample.sharesGloss) value += V3d(gloss.light[pixel]);
    return value;
  }
  V3d value(size_t pixel) const {
    PixelSample own;
    own.rest = rest[pixel];
    own.pattern = pattern[pixel];
    own.seen.material = seen.pixels[pixel].material;
    own.sharesGloss = sharesGloss[pixel];
    return complete(own, pixel);
  }
};

class Painter {
 public:
  Painter(const V3d& point, const PixelMap& map, const Transport& transport, const SeenSources& sources,
          uint64_t seed, const DrawingProgress& progress)
      : map_(map),
        sources_(sources),
        streams_(seed),
        progress_(progress),
        tracer_(point, transport),
        small_(smallSources(tracer_.paths(), map, sources, streams_.smallSources())),
        sampling_(transport.prepared().options().sampling) {}

  Raster draw(bool forScreen);

 private:
  Pixels tracePixels();
  std::optional<PixelSample> look(double x, double y, uint64_t seed, PixelParts parts);
  PixelSample middle(int column, int row, PixelParts parts);
  void gatherWhereUnknown(Pixels& pixels);
  std::vector<bool> uneven(const Raster& raster, double exposure) const;
  V3d average(const Pixels& pixels, int column, int row, double most);
  std::optional<size_t> alike(const Pixels& pixels, const PixelSample& sample, int column, int row) const;
  void refine(const Pixels& pixels, double exposure, bool forScreen, Raster& raster);
  void addSmallSources(Raster& raster) const;
  size_t at(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(map_.width()) + static_cast<size_t>(column);
  }
  void report(double done) const {
    if (progress_) progress_(done);
  }

  const PixelMap& map_;
  const SeenSources& sources_;
  const PictureStreams streams_;
  const DrawingProgress& progress_;
  PixelTracer tracer_;
  const SmallSources small_;
  const SpectralSampling* const sampling_;
};

// Empty beyond the rim, and where a small source is seen, which is added later.
std::optional<PixelSample> Painter::look(double x, double y, uint64_t seed, PixelParts parts) {
  const auto direction = map_.direction(x, y);
  if (!direction) return std::nullopt;
  const PixelSample sample = tracer_.trace(*direction, seed, parts);
  if (!small_.images.empty() && sources_.isOneStraight(sample.shown, small_.images)) return std::nullopt;
  return sample;
}

PixelSample Painter::middle(int column, int row, PixelParts parts) {
  const size_t pixel = at(column, row);
  if (!map_.direction(column + .5, row + .5)) return {};
  auto sample = look(column + .5, row + .5, streams_.middle(pixel), parts);
  for (size_t i = 0; !sample && i < Tuning::kBeside.size(); ++i)
    sample = look(column + .5 + Tuning::kBeside[i][0], row + .5 + Tuning::kBeside[i][1],
                  streams_.aside(pixel, i), parts);
  return sample.value_or(PixelSample{});
}

Pixels Painter::tracePixels() {
  Pixels pixels(map_);
  for (int row = 0; row < map_.height(); ++row) {
    report(kTracingShare * row / map_.height());
    for (int column = 0; column < map_.width(); ++column) {
      // One pixel of each block gathers. Which one it is changes from block to block, lest the blocks show.
      const int blockColumn = column / Tuning::kSharing, blockRow = row / Tuning::kSharing;
      const auto chosen = static_cast<int>(mixBits(streams_.middle(at(blockColumn, blockRow))) %
                                           (Tuning::kSharing * Tuning::kSharing));
      const bool gathers = column % Tuning::kSharing == chosen % Tuning::kSharing &&
                           row % Tuning::kSharing == chosen / Tuning::kSharing;
      pixels.set(at(column, row), middle(column, row, gathers ? PixelParts::all : PixelParts::noIndirect),
                 gathers);
    }
  }
  return pixels;
}

// Small surfaces may have no pixel that gathers.
void Painter::gatherWhereUnknown(Pixels& pixels) {
  for (int row = 0; row < map_.height(); ++row)
    for (int column = 0; column < map_.width(); ++column) {
      const size_t pixel = at(column, row);
      if (pixels.seen.pixels[pixel].material == kNone || pixels.indirect.known[pixel] > 0) continue;
      pixels.indirect.light[pixel] = Imath::V3f(middle(column, row, PixelParts::all).indirect);
    }
}

// The pixels that differ visibly from a neighbor.
std::vector<bool> Painter::uneven(const Raster& raster, double exposure) const {
  std::vector<bool> marked(map_.count(), false);
  const auto differ = [&](size_t a, size_t b) {
    const V3d of = exposure * valueAt(raster, a), other = exposure * valueAt(raster, b);
    for (int c = 0; c < 3; ++c)
      if (std::abs(sRgb(std::max(0., of[c])) - sRgb(std::max(0., other[c]))) > Tuning::kVisible) return true;
    return false;
  };
  for (int row = 0; row < map_.height(); ++row)
    for (int column = 0; column < map_.width(); ++column) {
      const size_t here = at(column, row);
      const auto compare = [&](size_t there) {
        if (differ(here, there)) marked[here] = marked[there] = true;
      };
      if (row + 1 < map_.height()) compare(at(column, row + 1));
      if (column + 1 < map_.width())
        compare(here + 1);
      else if (map_.wraps())
        compare(at(0, row));
    }
  return marked;
}

// The pixel nearest to a place whose surface is that of the sample.
std::optional<size_t> Painter::alike(const Pixels& pixels, const PixelSample& sample, int column,
                                     int row) const {
  constexpr int kOrder[9][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
  for (const auto& step : kOrder) {
    int x = column + step[0];
    const int y = row + step[1];
    if (map_.wraps()) x = (x + map_.width()) % map_.width();
    if (x < 0 || y < 0 || x >= map_.width() || y >= map_.height()) continue;
    const size_t pixel = at(x, y);
    if (mayShare(sample.seen, pixels.seen.pixels[pixel], kOfIndirect) &&
        sample.sharesGloss == pixels.sharesGloss[pixel])
      return pixel;
  }
  return std::nullopt;
}

V3d Painter::average(const Pixels& pixels, int column, int row, double most) {
  constexpr int kSide = Tuning::kSide;
  V3d sum(0, 0, 0);
  int samples = 0;
  for (int part = 0; part < kSide * kSide; ++part) {
    const double x = column + (part % kSide + .5) / kSide, y = row + (part / kSide + .5) / kSide;
    const uint64_t seed = streams_.part(at(column, row), static_cast<size_t>(part));
    auto sample = look(x, y, seed, PixelParts::restAlone);
    if (!sample) continue;
    V3d value;
    if (sample->seen.material == kNone) {
      value = sample->value();
    } else if (const auto pixel = alike(pixels, *sample, column, row)) {
      value = pixels.complete(*sample, *pixel);
    } else {
      sample = look(x, y, seed, PixelParts::all);
      value = sample ? sample->value() : V3d(0, 0, 0);
    }
    for (int c = 0; c < 3; ++c) sum[c] += std::clamp(value[c], 0., most);
    ++samples;
  }
  return samples > 0 ? sum / samples : pixels.value(at(column, row));
}

void Painter::refine(const Pixels& pixels, double exposure, bool forScreen, Raster& raster) {
  const std::vector<bool> marked = uneven(raster, exposure);
  const double most = forScreen ? 1 / exposure : std::numeric_limits<double>::infinity();
  for (int row = 0; row < map_.height(); ++row) {
    report(kTracingShare + (1 - kTracingShare) * row / map_.height());
    for (int column = 0; column < map_.width(); ++column)
      if (marked[at(column, row)]) setValue(raster, at(column, row), average(pixels, column, row, most));
  }
}

void Painter::addSmallSources(Raster& raster) const {
  for (const auto& [pixel, spot] : small_.spots) {
    const double whole = std::max(map_.solidAngle(pixel), spot.solidAngle);
    setValue(raster, pixel,
             valueAt(raster, pixel) * (1 - spot.solidAngle / whole) +
                 shownRgb(meanRadiance(spot.light, whole).color, sampling_));
  }
}

Raster Painter::draw(bool forScreen) {
  Pixels pixels = tracePixels();
  smoothLight(pixels.seen, kOfIndirect, pixels.indirect);
  smoothLight(pixels.seen, kOfGloss, pixels.gloss);
  gatherWhereUnknown(pixels);
  Raster raster{map_.width(), map_.height(), std::vector<float>(3 * map_.count())};
  for (size_t pixel = 0; pixel < map_.count(); ++pixel) setValue(raster, pixel, pixels.value(pixel));
  const double exposure = exposureOf(raster, map_);
  refine(pixels, exposure, forScreen, raster);
  addSmallSources(raster);
  if (forScreen) toScreen(raster, exposure);
  return raster;
}

}  // namespace

Raster drawPoint(const V3d& point, const PixelMap& map, const Transport& transport,
                 const SeenSources& sources, uint64_t seed, bool forScreen, const DrawingProgress& progress) {
  return Painter(point, map, transport, sources, seed, progress).draw(forScreen);
}

}  // namespace rsphere
