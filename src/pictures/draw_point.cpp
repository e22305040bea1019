#include "pictures/draw_point.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/colorimetry.h"
#include "base/scrambled_sequence.h"
#include "image/picture_formats.h"
#include "pictures/pixel_tracer.h"
#include "pictures/tuning.h"
#include "rays/ray_functions.h"

namespace rsphere {
namespace {

using OfPictures = tuning::Pictures;

// Two points on a ball may share light if each is near the plane of the other, within
// OfPictures::kNear. The cosine of the angle between their normals is then at least this. Normals of
// surfaces that meet in an edge differ more.
const float kSameNormal = 1 - 2 * OfPictures::kNear * OfPictures::kNear;

const Smoothing kOfIndirect{OfPictures::kIndirectPasses, OfPictures::kFinePasses, OfPictures::kSameLight,
                            kSameNormal, OfPictures::kNear};
// Images in panes and mirrors are gathered with few rays at each pixel.
const Smoothing kOfImages{OfPictures::kIndirectPasses, OfPictures::kFinePasses, OfPictures::kSameLight,
                          OfPictures::kSameGlossNormal, OfPictures::kNear};
const Smoothing kOfGloss{OfPictures::kFinePasses, 0,   0, OfPictures::kSameGlossNormal,
                         OfPictures::kNear,       true};
// The first pass blurs the edges of sharp shadows by a pixel. refine() traces these pixels again, because
// they differ visibly from their neighbors.
const Smoothing kOfDirect{1, OfPictures::kFinePasses, OfPictures::kSameLight, kSameNormal, OfPictures::kNear};

// Steps from a pixel to itself and its neighbors, the nearest first.
constexpr int kNeighbors[9][2] = {{0, 0}, {1, 0},  {-1, 0}, {0, 1},  {0, -1},
                                  {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};

constexpr double kTracingShare = .85;  // of the time of a picture; for progress reports only

// The seeds of a picture's random numbers, each named after its use.
class PictureStreams {
 public:
  explicit PictureStreams(uint64_t seed) : seed_(seed) {}
  uint64_t smallSources() const { return mixBits(seed_ + 1); }
  uint64_t middle(size_t pixel) const { return mixBits(seed_ + 16 + pixel); }
  // beside: index in OfPictures::kBeside.
  uint64_t aside(size_t pixel, size_t beside) const { return mixBits(middle(pixel) + 1 + beside); }
  // repeat: below OfPictures::kRepeats.
  uint64_t direct(size_t pixel, int repeat) const {
    return mixBits(middle(pixel) + 128 + static_cast<uint64_t>(repeat));
  }
  uint64_t places(size_t pixel) const { return mixBits(middle(pixel) + 63); }
  // place: below OfPictures::kMostRays.
  uint64_t around(size_t pixel, size_t place) const { return mixBits(middle(pixel) + 64 + place); }

 private:
  uint64_t seed_;
};

// The light of small sources in one pixel.
struct Spot {
  double solidAngle = 0;
  Irradiance light;
};

// The sources that pixels may miss: their images, and the light that they add to each pixel.
struct SmallSources {
  std::vector<SeenSources::Image> images;
  std::map<size_t, Spot> spots;  // by pixel
};

SmallSources smallSources(const PathsFrom& paths, const PixelMap& map, const SeenSources& sources,
                          uint64_t seed) {
  SmallSources small{sources.findImages(paths.point(), map.count(), 0), {}};
  // Pixels are smaller near the rim and the poles.
  for (SeenSources::Image& image : small.images) {
    const std::optional<size_t> pixel = map.pixelOf(image.region.sample(.5, .5));
    const double there = pixel ? map.solidAngle(*pixel) : 0;
    const double pixels = there > 0 ? image.solidAngle / there : OfPictures::kSmallest;
    image.rays = pixels < OfPictures::kSmallest ? OfPictures::kSmallest * std::max(1., pixels) : 0;
  }
  std::erase_if(small.images, [](const auto& image) { return image.rays == 0; });
  for (const SeenSources::Sample& s : sources.sample(paths, small.images, seed)) {
    const std::optional<size_t> pixel = map.pixelOf(s.direction.direction);
    if (!(s.direction.solidAngle > 0) || !pixel) continue;
    Spot& spot = small.spots[*pixel];
    spot.solidAngle += s.direction.solidAngle;
    spot.light += irradianceFrom(s.direction.value, s.direction.solidAngle);
  }
  return small;
}

// All pixels of a picture, by component.
struct Pixels {
  SeenSurfaces seen, mirrors;
  PixelLight indirect, gloss, direct, mirrored;
  // The light that the ray through the middle of a pixel finds.
  struct Middle {
    V3d rest{0, 0, 0}, pattern{1, 1, 1};
    Imath::V3f direct{0, 0, 0};  // before smoothing
    bool sharesGloss = false, sharesDirect = false, isTraced = false;
  };
  std::vector<Middle> middles;

  explicit Pixels(const PixelMap& map) : seen{map.width(), map.height(), map.wraps(), {}}, mirrors(seen) {
    seen.pixels.resize(map.count());
    mirrors.pixels.resize(map.count());
    for (PixelLight* component : {&indirect, &gloss, &direct, &mirrored}) {
      component->light.assign(map.count(), Imath::V3f(0, 0, 0));
      component->known.assign(map.count(), 0);
    }
    middles.resize(map.count());
  }
  // Pixels that are not set are black.
  void set(size_t pixel, const PixelSample& sample, bool hasIndirect) {
    seen.pixels[pixel] = sample.seen;
    indirect.light[pixel] = Imath::V3f(sample.indirect);
    indirect.known[pixel] = hasIndirect || !sample.leftOut.indirect ? 1 : 0;
    gloss.light[pixel] = Imath::V3f(sample.gloss);
    gloss.known[pixel] = sample.sharesGloss ? 1 : 0;
    direct.light[pixel] = Imath::V3f(sample.direct);
    direct.known[pixel] = sample.sharesDirect ? 1 : 0;
    mirrors.pixels[pixel] = sample.mirror;
    mirrored.light[pixel] = Imath::V3f(sample.mirrored);
    mirrored.known[pixel] = sample.mirror.material != kNone ? 1 : 0;
    middles[pixel] = {sample.rest,        sample.pattern,      direct.light[pixel],
                      sample.sharesGloss, sample.sharesDirect, true};
  }
  // The light of a sample with all components. Components that the sample lacks come from the given pixel.
  V3d complete(const PixelSample& sample, size_t pixel) const {
    V3d value = sample.rest + sample.direct;
    if (sample.seen.material != kNone) value += sample.pattern * V3d(indirect.light[pixel]);
    if (sample.sharesGloss) value += V3d(gloss.light[pixel]);
    const bool sameImage = mayShare(sample.mirror, mirrors.pixels[pixel], kOfImages);
    return value + (sameImage ? V3d(mirrored.light[pixel]) : sample.mirrored);
  }
  // The sample of the ray through the middle of the pixel.
  PixelSample own(size_t pixel) const {
    const Middle& middle = middles[pixel];
    PixelSample own;
    own.rest = middle.rest;
    own.direct = V3d(middle.direct);
    own.pattern = middle.pattern;
    own.seen.material = seen.pixels[pixel].material;
    own.sharesGloss = middle.sharesGloss;
    own.mirror = mirrors.pixels[pixel];
    own.mirrored = V3d(mirrored.light[pixel]);
    return own;
  }
  V3d value(size_t pixel) const {
    PixelSample sample = own(pixel);
    if (middles[pixel].sharesDirect) sample.direct = V3d(direct.light[pixel]);
    return complete(sample, pixel);
  }
};

// Averages the rays of a pixel, and decides whether they differ visibly.
class RaysOfPixel {
 public:
  RaysOfPixel(const ToneCurve& curve, bool forScreen) : curve_(curve), forScreen_(forScreen) {}

  // direct: the direct light of a ray that hits the surface in the middle of the pixel.
  void add(const V3d& value, const std::optional<V3d>& direct) {
    const V3d shown = curve_.shown(value);
    for (int c = 0; c < 3; ++c) {
      sum_[c] += forScreen_ ? shown[c] : std::max(0., value[c]);
      darkest_[c] = std::min(darkest_[c], sRgb(shown[c]));
      brightest_[c] = std::max(brightest_[c], sRgb(shown[c]));
    }
    ++count_;
    if (!direct) return;
    ++direct_.rays;
    direct_.least = std::min(direct_.least, direct->length());
    direct_.most = std::max(direct_.most, direct->length());
  }
  bool areOfOneSurface() const { return direct_.rays == count_; }
  bool crossShadow() const { return direct_.most - direct_.least > OfPictures::kSameLight * direct_.most; }
  bool differ() const {
    const V3d range = brightest_ - darkest_;
    return std::max({range.x, range.y, range.z}) > OfPictures::kVisible;
  }
  // Empty without rays.
  std::optional<V3d> mean() const {
    if (count_ == 0) return std::nullopt;
    return forScreen_ ? curve_.radiance(sum_ / count_) : sum_ / count_;
  }

 private:
  const ToneCurve& curve_;
  bool forScreen_;
  V3d sum_{0, 0, 0}, darkest_{kFarAway, kFarAway, kFarAway}, brightest_{0, 0, 0};
  int count_ = 0;
  struct {
    double least = kFarAway, most = 0;
    int rays = 0;
  } direct_;  // of the rays that hit the surface in the middle of the pixel
};

// Removes the noise of soft shadows. Differences are judged relative to all diffuse light, as the eye
// perceives them. In indirectly lit places, the noise of direct light is therefore not visible.
void smoothDirect(Pixels& pixels) {
  std::vector<Imath::V3f>& light = pixels.direct.light;
  const std::vector<Imath::V3f>& indirect = pixels.indirect.light;
  for (size_t i = 0; i < light.size(); ++i) light[i] += indirect[i];
  smoothLight(pixels.seen, kOfDirect, pixels.direct);
  for (size_t i = 0; i < light.size(); ++i) light[i] -= indirect[i];
}

// Whether the direct light of two pixels that show one surface differs by more than smoothing may remove.
bool isShadowBetween(const Pixels& pixels, size_t here, size_t there) {
  if (!pixels.middles[here].sharesDirect || !pixels.middles[there].sharesDirect ||
      !mayShare(pixels.seen.pixels[here], pixels.seen.pixels[there], kOfDirect))
    return false;
  const Imath::V3f a = pixels.middles[here].direct + pixels.indirect.light[here],
                   b = pixels.middles[there].direct + pixels.indirect.light[there], apart = b - a;
  return apart.length() > OfPictures::kSameLight * (a + b).length() / 2;
}

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
        sampling_(transport.prepared().options().sampling),
        sharing_(isLitByLamps(transport.prepared()) ? OfPictures::kSharingByLamps : OfPictures::kSharing) {}

  Raster draw(bool forScreen, double white) {
    Pixels pixels = tracePixels();
    smoothLight(pixels.seen, kOfIndirect, pixels.indirect);
    smoothLight(pixels.seen, kOfGloss, pixels.gloss);
    smoothLight(pixels.mirrors, kOfImages, pixels.mirrored);
    gatherWhereUnknown(pixels);
    repeatDirect(pixels);
    smoothDirect(pixels);
    Raster raster{map_.width(), map_.height(), std::vector<float>(3 * map_.count())};
    for (size_t pixel = 0; pixel < map_.count(); ++pixel) setValue(raster, pixel, pixels.value(pixel));
    const ToneCurve curve(raster, map_, white);
    refine(pixels, curve, forScreen, raster);
    addSmallSources(raster);
    if (forScreen) toScreen(raster, curve);
    return raster;
  }

 private:
  Pixels tracePixels() {
    Pixels pixels(map_);
    int traced = 0;
    for (int sweep = 0; sweep < OfPictures::kSweeps; ++sweep)
      for (int row = sweep; row < map_.height(); row += OfPictures::kSweeps) {
        report(kTracingShare * traced++ / map_.height());
        for (int column = 0; column < map_.width(); ++column) {
          const bool all = gathers(column, row);
          if (const auto sample = middle(column, row, all ? PixelParts::all : PixelParts::noIndirect))
            pixels.set(at(column, row), *sample, all);
        }
      }
    return pixels;
  }

  // Traces the ray through a position in the picture. Empty outside the rim of a fisheye, and where the ray
  // hits a small source, because the light of small sources is added later.
  std::optional<PixelSample> look(double x, double y, uint64_t seed, PixelParts parts) {
    const auto direction = map_.direction(x, y);
    if (!direction) return std::nullopt;
    const PixelSample sample = tracer_.trace(*direction, seed, parts);
    if (!small_.images.empty() && sources_.isOneStraight(sample.shown, small_.images)) return std::nullopt;
    return sample;
  }

  // look() through the middle of a pixel. If the ray hits a small source, rays beside the middle are tried.
  std::optional<PixelSample> middle(int column, int row, PixelParts parts) {
    const size_t pixel = at(column, row);
    if (!map_.direction(column + .5, row + .5)) return std::nullopt;
    auto sample = look(column + .5, row + .5, streams_.middle(pixel), parts);
    for (size_t i = 0; !sample && i < OfPictures::kBeside.size(); ++i)
      sample = look(column + .5 + OfPictures::kBeside[i][0], row + .5 + OfPictures::kBeside[i][1],
                    streams_.aside(pixel, i), parts);
    return sample;
  }

  // Gathers at pixels that smoothing left without indirect light: on small surfaces, none may gather.
  void gatherWhereUnknown(Pixels& pixels) {
    for (int row = 0; row < map_.height(); ++row)
      for (int column = 0; column < map_.width(); ++column) {
        const size_t pixel = at(column, row);
        if (pixels.seen.pixels[pixel].material == kNone || pixels.indirect.known[pixel] > 0) continue;
        if (const auto sample = middle(column, row, PixelParts::all))
          pixels.indirect.light[pixel] = Imath::V3f(sample->indirect);
      }
  }

  // Traces the direct light of noisy soft shadows several times. smoothLight() could not distinguish such
  // strong noise from the edge of a shadow, and the edge would become ragged.
  void repeatDirect(Pixels& pixels) {
    const std::vector<bool> marked =
        differing(2, [&](size_t here, size_t there) { return isShadowBetween(pixels, here, there); });
    for (int row = 0; row < map_.height(); ++row)
      for (int column = 0; column < map_.width(); ++column) {
        const size_t pixel = at(column, row);
        if (!marked[pixel]) continue;
        V3d sum(pixels.middles[pixel].direct);
        int count = 1;
        for (int repeat = 0; repeat < OfPictures::kRepeats; ++repeat) {
          const auto sample =
              look(column + .5, row + .5, streams_.direct(pixel, repeat), PixelParts::restAlone);
          if (!sample || !mayShare(pixels.seen.pixels[pixel], sample->seen, kOfDirect)) continue;
          sum += sample->direct;
          ++count;
        }
        pixels.direct.light[pixel] = pixels.middles[pixel].direct = Imath::V3f(sum / count);
      }
  }

  // Marks both pixels of each pair that differs, of those in a row or a column at most `reach` apart.
  template <typename Differ>
  std::vector<bool> differing(int reach, const Differ& differ) const {
    std::vector<bool> marked(map_.count(), false);
    for (int row = 0; row < map_.height(); ++row)
      for (int column = 0; column < map_.width(); ++column)
        for (int step = 1; step <= reach; ++step)
          for (const auto& there : {pixelAt(column + step, row), pixelAt(column, row + step)})
            if (there && differ(at(column, row), *there)) marked[at(column, row)] = marked[*there] = true;
    return marked;
  }

  // In each block one pixel gathers. Its position is random, so that no grid is visible.
  bool gathers(int column, int row) const {
    const auto chosen = static_cast<int>(mixBits(streams_.middle(at(column / sharing_, row / sharing_))) %
                                         static_cast<uint64_t>(sharing_ * sharing_));
    return column % sharing_ == chosen % sharing_ && row % sharing_ == chosen / sharing_;
  }

  // Where in a pixel its rays are: at offsets kAround from its middle, and all over it.
  Imath::V2d placeOf(size_t pixel, size_t place) const {
    constexpr size_t kGiven = OfPictures::kAround.size();
    if (place < kGiven)
      return Imath::V2d(.5 + OfPictures::kAround[place][0], .5 + OfPictures::kAround[place][1]);
    Random rest(0);  // not used
    ScrambledPoint even(static_cast<uint32_t>(place - kGiven), streams_.places(pixel), rest);
    const double x = even.uniform();
    return Imath::V2d(x, even.uniform());
  }

  // Traces a ray through a place in a pixel, and adds it with the shared components of nearby pixels. Adds
  // none outside the rim, and where the ray hits a small source.
  void addRay(const Pixels& pixels, int column, int row, size_t place, RaysOfPixel& rays) {
    const Imath::V2d in = placeOf(at(column, row), place);
    const uint64_t seed = streams_.around(at(column, row), place);
    auto sample = look(column + in.x, row + in.y, seed, PixelParts::restAlone);
    std::optional<V3d> direct;
    if (sample && sample->seen.material != kNone) {
      if (const auto pixel = alike(pixels, *sample, column, row)) {
        if (sample->sharesDirect && *pixel == at(column, row)) direct = sample->direct;
        return rays.add(pixels.complete(*sample, *pixel), direct);
      }
      sample = look(column + in.x, row + in.y, seed, PixelParts::all);
    }
    if (sample) rays.add(sample->value(), direct);
  }

  V3d average(const Pixels& pixels, int column, int row, RaysOfPixel rays) {
    const size_t pixel = at(column, row);
    if (pixels.middles[pixel].isTraced)
      rays.add(pixels.complete(pixels.own(pixel), pixel), V3d(pixels.middles[pixel].direct));
    const bool byShadow = isByShadow(pixels, column, row);
    for (size_t place = 0; place < OfPictures::kMostRays; ++place) {
      if (place == OfPictures::kCorners && !byShadow && !rays.differ()) break;
      if (place == OfPictures::kAround.size() && !(byShadow && rays.areOfOneSurface())) break;
      if (place == OfPictures::kByShadows && !rays.crossShadow()) break;
      addRay(pixels, column, row, place, rays);
    }
    return rays.mean().value_or(pixels.value(pixel));
  }

  // Empty outside the picture.
  std::optional<size_t> pixelAt(int column, int row) const {
    if (map_.wraps()) column = (column + map_.width()) % map_.width();
    if (column < 0 || row < 0 || column >= map_.width() || row >= map_.height()) return std::nullopt;
    return at(column, row);
  }

  // Whether the edge of a shadow passes a pixel, or is between it and the next one.
  bool isByShadow(const Pixels& pixels, int column, int row) const {
    for (const auto& step : kNeighbors)
      if (const auto next = pixelAt(column + step[0], row + step[1]))
        if (isShadowBetween(pixels, at(column, row), *next)) return true;
    return false;
  }

  // The nearest pixel to this column and row, within one pixel, that shows the surface of the sample.
  std::optional<size_t> alike(const Pixels& pixels, const PixelSample& sample, int column, int row) const {
    for (const auto& step : kNeighbors) {
      const auto pixel = pixelAt(column + step[0], row + step[1]);
      if (pixel && mayShare(sample.seen, pixels.seen.pixels[*pixel], kOfIndirect) &&
          sample.sharesGloss == pixels.middles[*pixel].sharesGloss)
        return pixel;
    }
    return std::nullopt;
  }

  void refine(const Pixels& pixels, const ToneCurve& curve, bool forScreen, Raster& raster) {
    const std::vector<bool> marked = differing(1, [&](size_t here, size_t there) {
      const V3d one = curve.shown(valueAt(raster, here)), other = curve.shown(valueAt(raster, there));
      for (int c = 0; c < 3; ++c)
        if (std::abs(sRgb(one[c]) - sRgb(other[c])) > OfPictures::kVisible) return true;
      return false;
    });
    const double all = std::max<double>(1, static_cast<double>(std::ranges::count(marked, true)));
    const RaysOfPixel none(curve, forScreen);
    int done = 0;
    for (int row = 0; row < map_.height(); ++row) {
      report(kTracingShare + (1 - kTracingShare) * done / (all + 1));
      for (int column = 0; column < map_.width(); ++column) {
        if (!marked[at(column, row)]) continue;
        setValue(raster, at(column, row), average(pixels, column, row, none));
        ++done;
      }
    }
  }

  void addSmallSources(Raster& raster) const {
    for (const auto& [pixel, spot] : small_.spots) {
      const double whole = std::max(map_.solidAngle(pixel), spot.solidAngle);
      setValue(raster, pixel,
               valueAt(raster, pixel) * (1 - spot.solidAngle / whole) +
                   shownRgb(meanRadiance(spot.light, whole).color, sampling_));
    }
  }

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
  const int sharing_;  // one pixel in a square of this side gathers
};

}  // namespace

Raster drawPoint(const V3d& point, const PixelMap& map, const Transport& transport,
                 const SeenSources& sources, uint64_t seed, bool forScreen, double white,
                 const DrawingProgress& progress) {
  return Painter(point, map, transport, sources, seed, progress).draw(forScreen, white);
}

}  // namespace rsphere
