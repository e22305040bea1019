#include "light/sources.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/overloaded.h"
#include "light/relays.h"
#include "scene/frame.h"

namespace rsphere {
namespace {

bool isParallelogram(std::span<const V3d> v) {
  if (v.size() != 4) return false;
  const V3d gap = v[0] - v[1] + v[2] - v[3];
  return gap.length() <= 1e-4 * ((v[1] - v[0]).length() + (v[3] - v[0]).length());
}

bool isConvex(std::span<const V3d> v, const V3d& normal) {
  for (size_t i = 0; i < v.size(); ++i) {
    const V3d& a = v[i];
    const V3d& b = v[(i + 1) % v.size()];
    const V3d& c = v[(i + 2) % v.size()];
    if ((b - a).cross(c - b).dot(normal) < 0) return false;
  }
  return true;
}

void setSquare(LightSource& source) {
  frame(source.normal, source.u, source.v);
  const double half = std::sqrt(source.area) / 2;
  source.u *= half;
  source.v *= half;
}

// If vertices deviate from the polygon's mean plane by more than rounding, the points that the unit square is
// mapped to lie outside that plane.
bool isFlat(const Polygon& polygon, std::span<const V3d> vertices) {
  return thicknessOf(polygon, vertices) <= 1e-9 * std::sqrt(areaOf(polygon, vertices));
}

void setShape(LightSource& source, const Polygon& polygon, const Scene& scene) {
  const auto v = std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices);
  source.normal = polygon.normal;
  source.area = areaOf(polygon, scene.vertices);
  for (const V3d& p : v) source.center += p / static_cast<double>(v.size());
  for (const V3d& p : v) source.radius = std::max(source.radius, (p - source.center).length());
  source.hitsWhereAimed = isFlat(polygon, scene.vertices);
  if (isParallelogram(v)) {
    source.map = LightSource::Map::parallelogram;
    source.u = (v[1] - v[0]) / 2;
    source.v = (v[3] - v[0]) / 2;
    return;
  }
  // A concave polygon is sampled by a square of the same area around its center; some samples miss it.
  setSquare(source);
  source.map = LightSource::Map::square;
  if (!isConvex(v, polygon.normal)) {
    source.hitsWhereAimed = false;
    return;
  }
  source.map = LightSource::Map::fan;
  source.fanVertices.assign(v.begin(), v.end());
  double sum = 0;
  for (size_t i = 2; i < v.size(); ++i) {
    sum += (v[i - 1] - v[0]).cross(v[i] - v[0]).length() / 2;
    source.fanArea.push_back(sum);
  }
  for (double& a : source.fanArea) a /= sum;
}

void setShape(LightSource& source, const Ring& ring, const Scene&) {
  source.map = LightSource::Map::disk;
  source.center = ring.center;
  source.normal = ring.normal;
  source.radius = ring.outer;
  source.area = kPi * ring.outer * ring.outer;
  frame(ring.normal, source.u, source.v);
  source.u *= ring.outer;
  source.v *= ring.outer;
}

void setShape(LightSource& source, const Sphere& sphere, const Scene&) {
  source.map = LightSource::Map::ball;
  source.center = sphere.center;
  source.radius = sphere.radius;
  source.hitsWhereAimed = !sphere.inward;
}

void setShape(LightSource& source, const Cone& cone, const Scene&) {
  source.map = LightSource::Map::tube;
  source.u = cone.length / 2 * cone.axis;
  source.center = cone.base + source.u;
  source.radius = std::hypot(cone.length / 2, cone.radius0);
  source.area = 2 * cone.radius0 * cone.length;
}

void setShape(LightSource& source, const Distant& distant, const Scene&) {
  source.map = LightSource::Map::cone;
  source.distant = true;
  source.center = distant.direction;
  source.cosHalfAngle = distant.cosHalfAngle;
  source.sinHalfAngle = std::sin(distant.halfAngle);
}

// Whether every ray that is aimed at a part of the shape hits it. A goal may have any shape; one that cannot
// be aimed at is only hit by chance.
bool canBeAimedAt(ShapeRef shape, const Scene& scene) {
  return visit(Overloaded{
                   [&](const Polygon& polygon) {
                     return isConvex(std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices),
                                     polygon.normal);
                   },
                   [](const Ring& ring) { return ring.inner == 0; },
                   [](const Sphere& sphere) { return !sphere.inward; },
                   [](const Cone& cone) { return !cone.inward && cone.radius0 == cone.radius1; },
                   [](const Distant&) { return false; },
                   [](const NestedShape auto&) { return false; },
               },
               shape);
}

}  // namespace

LightSources::LightSources(const Scene& scene) : scene_(scene) {
  findSources();
  measureParts();
}

LightSources::LightSources(const Scene& scene, int relays, const SurfaceFunctions& functions,
                           const rad::Warn& warn)
    : scene_(scene) {
  findSources();
  addVirtualSources(scene, relays, functions, warn, sources_);
  measureParts();
}

void LightSources::measureParts() {
  for (LightSource& source : sources_) {
    source.outermost = !source.distant ? source.radius : source.cosHalfAngle > 0 ? source.sinHalfAngle : 1;
    source.extentU = source.u.length();
    source.extentV = source.v.length();
    // A disk is split like the square of the same area, as in rtrace.
    if (source.map == LightSource::Map::disk) source.extentU = source.extentV = std::sqrt(source.area) / 2;
  }
}

void LightSources::findSources() {
  const auto add = [&](SurfaceId surface) -> LightSource& {
    LightSource& source = sources_.emplace_back();
    source.surface = surface;
    visit(Overloaded{
              [&](const PlainShape auto& shape) { setShape(source, shape, scene_); },
              [&](const Distant& distant) { setShape(source, distant, scene_); },
              [](const NestedShape auto&) {},
          },
          scene_.surfaces[surface].shape);
    return source;
  };
  // As in rtrace, luminous surfaces in octrees and meshes are visible but are not light sources.
  for (const SurfaceId i : scene_.outermostIds()) {
    const Surface& surface = scene_.surfaces[i];
    if (surface.material == kNone) continue;
    if (scene_.importance) {
      if (surface.goal && canBeAimedAt(surface.shape, scene_)) add(i);
      continue;
    }
    const Material* material = scene_.materialOf(surface);
    if (!material || !isSampled(*material)) continue;
    const double reach = reachOf(*material);
    if (reach != 0 && surface.shape.as<Distant>()) continue;
    LightSource& source = add(i);
    source.reach = reach;
    if (const auto* spot = std::get_if<Spotlight>(material)) source.spot = *spot;
  }
}

}  // namespace rsphere
