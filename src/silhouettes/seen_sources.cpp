#include "silhouettes/seen_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.h"
#include "base/even_sequence.h"
#include "base/overloaded.h"
#include "silhouettes/special_objects.h"
#include "silhouettes/tuning.h"

namespace rsphere {
namespace {

using std::numbers::pi;

// The sharp reflectance of a plane surface at this cosine of incidence. It ignores the color of metals, and
// includes both boundaries of panes. If it is 0 at one angle, it is 0 at all angles.
double sharpReflectance(const Material& material, double cosine = 1) {
  const auto mirrored = mirrorReflection(material);
  if (!mirrored) return 0;
  if (mirrored->boundaries > 0) {
    const double schlick = kGlassReflectance + (1 - kGlassReflectance) * std::pow(1 - cosine, 5);
    return std::min(1., mirrored->boundaries * schlick);
  }
  return mirrored->roughness > 0 ? 0 : mirrored->share;
}

// The area of a plane shape; of a ring including its hole.
double outlinedArea(ShapeRef shape, std::span<const V3d> vertices) {
  return match(
      shape, [&](const Polygon& polygon) { return areaOf(polygon, vertices); },
      [](const Ring& ring) { return pi * std::pow(ring.outer, 2); },
      [](const OneOf<Sphere, Cone, Distant> auto&) { return 0.; },
      [](const NestedShape auto&) { return 0.; });
}

bool emitsBehind(ShapeRef shape, const V3d& point) {
  const V3d* normal = planeNormal(shape);
  return normal && normal->dot(point) <= planeOffset(shape);
}

// Whether the shape fills its silhouette's region.
bool fills(ShapeRef shape, const Silhouette& s) {
  return match(
      shape, [](const OneOf<Sphere, Distant> auto&) { return true; },
      [&](const Polygon&) {
        return std::abs(s.regionSolidAngle() - s.solidAngle()) <= 1e-9 * s.solidAngle();
      },
      [](const OneOf<Cone, Ring> auto&) { return false; }, [](const NestedShape auto&) { return false; });
}

bool hits(const Scene& scene, ShapeRef shape, const V3d& point, const V3d& direction, ShapeHit& hit) {
  if (isPlain(shape)) return intersect(shape, scene.vertices, point, direction, kFarAway, hit, 0);
  // A distant source: all tested directions are within its cone.
  hit = {kFarAway, -direction, 1};
  return true;
}

struct Plane {
  V3d normal{0, 0, 1};
  double offset = 0;

  explicit Plane(ShapeRef flat) : normal(*planeNormal(flat)), offset(planeOffset(flat)) {}
  double height(const V3d& p) const { return normal.dot(p) - offset; }
  V3d mirrored(const V3d& p) const { return p - 2 * height(p) * normal; }
  V3d mirroredDirection(const V3d& d) const { return d - 2 * normal.dot(d) * normal; }
};

using Image = SeenSources::Image;

// The source, and the mirror if any, that an unobstructed ray to the image shows.
ShownSource shownBy(const PreparedScene& prepared, const Image& image) {
  return {prepared.lights().all()[image.source].surface, image.mirror};
}

ShapeRef shapeOf(const PreparedScene& prepared, const Image& image) {
  return prepared.scene().surfaces[shownBy(prepared, image).source].shape;
}

// A sensor is so small that its middle represents it.
bool isSensor(const PreparedScene& prepared, LightId source) {
  return prepared.scene().surfaces[prepared.lights().all()[source].surface].finish.sensor;
}

// The direction to a sensor (unit), and its solid angle, sr.
double sightOfSensor(const LightSource& light, const V3d& eye, V3d& direction) {
  const V3d to = light.center - eye;
  const PlaneLight& square = std::get<PlaneLight>(light.shape);
  direction = to.normalized();
  return square.area * std::max(0., -square.normal.dot(direction)) / to.length2();
}

// The point from which the source is seen: the point itself, or its mirror image behind the mirror.
V3d eyeOf(const Scene& scene, const Image& image, const V3d& point) {
  return image.mirror == kNone ? point : Plane(scene.surfaces[image.mirror].shape).mirrored(point);
}

// Sets ray, value and solid angle. The solid angle becomes 1 if the ray shows `expected`, which means that
// nothing hides the image, and 0 otherwise; it is scaled later.
void setRay(SeenSources::Sample& sample, const TracedRay& ray, const ShownSource& expected) {
  sample.ray = ray;
  sample.direction.toSource = true;
  if (!(ray.shown == expected)) return;
  sample.direction.value = ray.value;
  sample.direction.solidAngle = 1;
}

}  // namespace

SeenSources::SeenSources(const PreparedScene& prepared) : prepared_(prepared) {
  const Scene& scene = prepared.scene();
  apart_.assign(scene.surfaces.size(), false);
  const auto& lights = prepared.lights().all();
  for (const LightId i : lights.ids()) {
    const Surface& surface = scene.surfaces[lights[i].surface];
    const Material* material = scene.materialOf(surface);
    // Virtual sources are skipped: addMirrored() finds the images in mirrors that they represent.
    if (lights[i].isVirtual() || (material && std::holds_alternative<Illum>(*material))) continue;
    apart_[lights[i].surface] = true;
    haveSensors_ = haveSensors_ || surface.finish.sensor;
    sources_.push_back(i);
  }
  if (sources_.empty()) return;
  std::vector<std::pair<double, SurfaceId>> mirrors;  // by area
  for (const SurfaceId i : scene.outermostIds()) {
    const Surface& surface = scene.surfaces[i];
    const Material* material = scene.materialOf(surface);
    if (!material || !planeNormal(surface.shape) || !(sharpReflectance(*material) > 0)) continue;
    mirrors.push_back({-outlinedArea(surface.shape, scene.vertices), i});
  }
  std::ranges::sort(mirrors);
  for (const auto& [area, surface] : mirrors)
    if ((mirrors_.size() + 1) * sources_.size() <= tuning::SpecialObjects::kMostPlacedObjects)
      mirrors_.push_back(surface);
}

bool SeenSources::isOne(const ShownSource& s, const std::vector<Image>& images) const {
  if (s.source == kNone || !apart_[s.source]) return false;
  const auto& lights = prepared_.lights().all();
  return s.mirror == kNone || std::ranges::any_of(images, [&](const Image& image) {
           return image.mirror == s.mirror && lights[image.source].surface == s.source;
         });
}

bool SeenSources::isOneStraight(const ShownSource& s, const std::vector<Image>& images) const {
  const auto& lights = prepared_.lights().all();
  return s.source != kNone && s.mirror == kNone && std::ranges::any_of(images, [&](const Image& image) {
           return image.mirror == kNone && lights[image.source].surface == s.source;
         });
}

std::vector<SeenSources::Image> SeenSources::findImages(const V3d& point, size_t most,
                                                        double mirrorFactor) const {
  std::vector<Image> images;
  const Scene& scene = prepared_.scene();
  const std::span<const uint32_t> notHidden = prepared_.lights().hidden().notHiddenFrom(point);
  for (const LightId i : sources_) {
    if (!std::ranges::binary_search(notHidden, i.index())) continue;
    const Surface& surface = scene.surfaces[prepared_.lights().all()[i].surface];
    if (emitsBehind(surface.shape, point)) continue;
    Image image;
    image.source = i;
    image.region = silhouetteOf(surface.shape, scene.vertices, point);
    setExtent(image, point);
    if (!(image.solidAngle > 0)) continue;
    image.rays = std::pow(brightness(sourceRadiance(scene, surface)) * image.solidAngle,
                          tuning::SeenSources::kByLight);
    images.push_back(std::move(image));
  }
  const size_t straight = images.size();
  if (mirrorFactor > 0) addMirrored(point, images);
  for (size_t i = straight; i < images.size(); ++i) images[i].rays *= mirrorFactor;
  double sum = 0;
  for (const Image& image : images) sum += image.rays;
  for (Image& image : images) {
    const double enough = isSensor(prepared_, image.source)
                              ? 1
                              : std::max({tuning::SeenSources::kUsualRays,
                                          image.solidAngle / tuning::SeenSources::kSmallestPart,
                                          tuning::SeenSources::kSmallShare * static_cast<double>(most) /
                                              static_cast<double>(images.size())});
    image.rays = std::min(image.rays / sum * static_cast<double>(most), enough);
  }
  images.erase(std::remove_if(images.begin() + straight, images.end(),
                              [](const Image& i) { return i.rays < tuning::SeenSources::kSmallShare; }),
               images.end());
  // A ray shows the whole light of its direction, such as the sky behind a pane that mirrors a lamp. That is
  // much more than the light of the image if one ray in ten points has ten times the weight.
  const size_t sure = images.size() <= most ? images.size() : straight <= most ? straight : 0;
  for (size_t i = 0; i < sure; ++i) images[i].rays = std::max(images[i].rays, 1.);
  return images;
}

// Sets solidAngle, filled and region of an image as seen from an eye. window: silhouette of its mirror; null:
// seen directly.
void SeenSources::setExtent(Image& image, const V3d& eye, const Silhouette* window) const {
  if (isSensor(prepared_, image.source)) {
    V3d direction;
    image.solidAngle = sightOfSensor(prepared_.lights().all()[image.source], eye, direction);
    if (window && !window->contains(direction)) image.solidAngle = 0;
    return;
  }
  image.filled = fills(shapeOf(prepared_, image), image.region);
  if (window) image.region = image.region.within(*window);
  image.solidAngle = image.region.regionSolidAngle();
}

// The direction from an eye to the image at (u, v) of the unit square.
V3d SeenSources::directionIn(const Image& image, const V3d& eye, double u, double v) const {
  if (!isSensor(prepared_, image.source)) return image.region.sample(u, v);
  V3d direction;
  sightOfSensor(prepared_.lights().all()[image.source], eye, direction);
  return direction;
}

// Seen from the mirror image of the point, the mirror is a window through which the source is visible.
void SeenSources::addMirrored(const V3d& point, std::vector<Image>& images) const {
  const Scene& scene = prepared_.scene();
  const auto& lights = prepared_.lights().all();
  for (const SurfaceId m : mirrors_) {
    const Surface& mirror = scene.surfaces[m];
    const Material& material = *scene.materialOf(mirror);
    const Plane plane(mirror.shape);
    const double height = plane.height(point), side = height < 0 ? -1 : 1;
    if (height < 0 && mirrorReflection(material)->frontOnly) continue;
    const V3d behind = plane.mirrored(point);
    std::optional<Silhouette> window;
    for (const LightId i : sources_) {
      const LightSource& light = lights[i];
      if (light.surface == m) continue;
      const auto* cone = light.as<DistantLight>();
      const double before = cone ? side * plane.normal.dot(light.center) + cone->sinHalfAngle
                                 : side * plane.height(light.center) + light.radius;
      const Surface& surface = scene.surfaces[light.surface];
      if (before <= 0 || emitsBehind(surface.shape, behind)) continue;
      if (!window) window = silhouetteOf(mirror.shape, scene.vertices, behind);
      if (!(window->regionSolidAngle() > 0)) break;
      Image image;
      image.source = i;
      image.mirror = m;
      image.region = silhouetteOf(surface.shape, scene.vertices, behind);
      setExtent(image, behind, &*window);
      if (!(image.solidAngle > 0)) continue;
      const double cosine = std::abs(plane.normal.dot(directionIn(image, behind, .5, .5)));
      image.rays = std::pow(
          brightness(sourceRadiance(scene, surface)) * image.solidAngle * sharpReflectance(material, cosine),
          tuning::SeenSources::kByLight);
      images.push_back(std::move(image));
    }
  }
}

std::vector<SeenSources::Sample> SeenSources::sample(const PathsFrom& paths, const std::vector<Image>& images,
                                                     uint64_t seed) const {
  std::vector<Sample> samples;
  Random random(seed);
  // Images with less than one ray are sampled with that probability, with a weight that represents the
  // others.
  double due = random.uniform();
  for (size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i];
    Share share{static_cast<size_t>(image.rays), image.solidAngle};
    if (image.rays < 1) {
      due += image.rays;
      if (due < 1) continue;
      --due;
      share = {1, image.solidAngle / image.rays};
    }
    for (Sample& s : sampleImage(paths, image, share, random.bits())) {
      s.image = i;
      s.chance = std::min(image.rays, 1.);
      samples.push_back(std::move(s));
    }
  }
  return samples;
}

std::vector<SeenSources::Sample> SeenSources::sampleImage(const PathsFrom& paths, const Image& image,
                                                          const Share& share, uint64_t seed) const {
  Random random(seed);
  const V3d eye = eyeOf(prepared_.scene(), image, paths.point());
  const double filled = image.filled ? 1 : filledShare(image, eye, random);
  std::vector<Sample> samples;
  if (filled == 0) return samples;
  const size_t tries = std::max<size_t>(1, static_cast<size_t>(static_cast<double>(share.rays) / filled));
  const auto rows = static_cast<size_t>(std::sqrt(static_cast<double>(tries)));
  const size_t columns = tries / rows;
  for (size_t row = 0; row < rows; ++row)
    for (size_t column = 0; column < columns; ++column) {
      const Cell cell{row, column, rows, columns, random};
      auto s =
          image.mirror == kNone ? sampleStraight(paths, image, cell) : sampleMirrored(paths, image, cell);
      if (s) samples.push_back(std::move(*s));
    }
  // The solid angle of the image, which is known, is divided among the samples that hit the source.
  int aimed = 0;
  for (const Sample& s : samples) aimed += s.aimed;
  const double each = share.solidAngle * filled / std::max(1, aimed);
  for (Sample& s : samples) {
    s.part = each * s.aimed;
    s.direction.solidAngle *= each * s.clear;
  }
  return samples;
}

// The fraction of an image's region that shows the source if nothing is in front of it. eye: the point, or
// its mirror image.
double SeenSources::filledShare(const Image& image, const V3d& eye, Random& random) const {
  const ShapeRef shape = shapeOf(prepared_, image);
  const double shift1 = random.uniform(), shift2 = random.uniform();
  size_t met = 0;
  ShapeHit on;
  for (size_t i = 0; i < tuning::SeenSources::kShareTries; ++i) {
    const Imath::V2d u = evenly(i, shift1, shift2);
    met += hits(prepared_.scene(), shape, eye, image.region.sample(u.x, u.y), on) && on.cosine > 0;
  }
  return static_cast<double>(met) / tuning::SeenSources::kShareTries;
}

std::optional<SeenSources::Sample> SeenSources::sampleMirrored(const PathsFrom& paths, const Image& image,
                                                               const Cell& cell) const {
  const Scene& scene = prepared_.scene();
  const double v = (cell.column + cell.random.uniform()) / cell.columns,
               u = (cell.row + cell.random.uniform()) / cell.rows;
  const uint64_t seed = cell.random.bits();
  ShapeHit on;
  const V3d eye = eyeOf(scene, image, paths.point());
  const V3d direction = directionIn(image, eye, u, v);
  if (!hits(scene, shapeOf(prepared_, image), eye, direction, on) || !(on.cosine > 0)) return std::nullopt;
  Sample s;
  s.row = cell.row;
  s.direction.direction = Plane(scene.surfaces[image.mirror].shape).mirroredDirection(direction);
  setRay(s, paths.trace(s.direction.direction, seed), shownBy(prepared_, image));
  return s;
}

// Sends shadow rays to positions all over one cell of the image's grid. The sample is drawn from the rays
// that reached the source, or from all rays if all are blocked by opaque surfaces.
std::optional<SeenSources::Sample> SeenSources::sampleStraight(const PathsFrom& paths, const Image& image,
                                                               const Cell& cell) const {
  const V3d& point = paths.point();
  const SurfaceId source = shownBy(prepared_, image).source;
  const ShapeRef shape = shapeOf(prepared_, image);
  Sample s;
  s.row = cell.row;
  s.aimed = s.clear = 0;
  ShapeHit on, chosen{0, V3d(0, 0, 0), 0};
  for (size_t i = 0; i < tuning::SeenSources::kShadowsAlong; ++i)
    for (size_t k = 0; k < tuning::SeenSources::kShadowsAlong; ++k) {
      const double u = (cell.row + (i + cell.random.uniform()) / tuning::SeenSources::kShadowsAlong) /
                       cell.rows,
                   v = (cell.column + (k + cell.random.uniform()) / tuning::SeenSources::kShadowsAlong) /
                       cell.columns;
      const V3d direction = directionIn(image, point, u, v);
      const double lot = cell.random.uniform();
      if (!hits(prepared_.scene(), shape, point, direction, on) || !(on.cosine > 0)) continue;
      ++s.aimed;
      const bool clear = prepared_.tracer().shadow(point, direction, on.distance, source, nullptr,
                                                   kInSpace) != Shadow::blocked;
      s.clear += clear;
      // Reservoir sampling: the nth ray replaces the current choice with probability 1/n, so that all n are
      // equally probable.
      if (clear ? lot * s.clear < 1 : s.clear == 0 && lot * s.aimed < 1) {
        s.direction.direction = direction;
        chosen = on;
      }
    }
  if (s.aimed == 0) return std::nullopt;
  const SourceSample at{s.direction.direction, 0,           chosen.distance, chosen.cosine,
                        chosen.normal,         image.source};
  setRay(s, paths.traceToSource(at, cell.random.bits()), shownBy(prepared_, image));
  return s;
}

}  // namespace rsphere
