#include "light/light_source.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/constants.h"
#include "base/frame.h"

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

// False if the vertices deviate from the polygon's mean plane by more than rounding. The points that the unit
// square is mapped to then lie outside that plane.
bool isFlat(const Polygon& polygon, std::span<const V3d> vertices) {
  return thicknessOf(polygon, vertices) <= 1e-9 * std::sqrt(areaOf(polygon, vertices));
}

// Half the sides of a square of this area with this normal.
void setSquare(PlaneLight& light) {
  std::tie(light.u, light.v) = frame(light.normal, std::sqrt(light.area) / 2);
}

void add(PlaneLight::Triangles& triangles, const V3d& a, const V3d& b, const V3d& c) {
  triangles.areas.push_back((triangles.areas.empty() ? 0 : triangles.areas.back()) +
                            (b - a).cross(c - a).length() / 2);
  triangles.vertices.insert(triangles.vertices.end(), {a, b, c});
}

// The triangles of a convex polygon around its first vertex; otherwise the halves of trapezoids between the
// heights of its vertices, which cover what rays meet: by odd crossings, with holes that are connected by
// seams.
PlaneLight::Triangles trianglesOf(std::span<const V3d> v, const V3d& normal) {
  PlaneLight::Triangles triangles;
  if (isConvex(v, normal)) {
    for (size_t i = 2; i < v.size(); ++i) add(triangles, v[0], v[i - 1], v[i]);
    return triangles;
  }
  const auto [right, up] = frame(normal);
  std::vector<double> height;
  for (const V3d& p : v) height.push_back(p.dot(up));
  std::vector<double> levels = height;
  std::ranges::sort(levels);
  const double thin = 1e-9 * (levels.back() - levels.front());
  for (size_t l = 1; l < levels.size(); ++l) {
    const double low = levels[l - 1], high = levels[l];
    if (high - low <= thin) continue;
    std::vector<std::pair<V3d, V3d>> sides;  // what edges have between the heights: lower and upper end
    for (size_t i = 0; i < v.size(); ++i) {
      const size_t next = (i + 1) % v.size();
      if (std::min(height[i], height[next]) > low || std::max(height[i], height[next]) < high) continue;
      const V3d along = (v[next] - v[i]) / (height[next] - height[i]);
      sides.emplace_back(v[i] + (low - height[i]) * along, v[i] + (high - height[i]) * along);
    }
    std::ranges::sort(sides, {}, [&, r = right](const auto& s) { return (s.first + s.second).dot(r); });
    for (size_t i = 1; i < sides.size(); i += 2) {
      add(triangles, sides[i - 1].first, sides[i].first, sides[i].second);
      add(triangles, sides[i - 1].first, sides[i].second, sides[i - 1].second);
    }
  }
  return triangles;
}

// Whether triangles cover the polygon: not if it crosses itself.
bool cover(const PlaneLight::Triangles& triangles, double area) {
  return !triangles.areas.empty() && std::abs(triangles.areas.back() - area) <= 1e-6 * area;
}

LightSource sourceOf(const Polygon& polygon, const Scene& scene) {
  const auto v = std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices);
  LightSource source;
  for (const V3d& p : v) source.center += p / static_cast<double>(v.size());
  source.hitsWhereAimed = isFlat(polygon, scene.vertices);
  PlaneLight light{.normal = polygon.normal, .area = areaOf(polygon, scene.vertices)};
  if (isParallelogram(v)) {
    light.u = (v[1] - v[0]) / 2;
    light.v = (v[3] - v[0]) / 2;
  } else {
    setSquare(light);
    const bool convex = isConvex(v, polygon.normal);
    if (convex || scene.importance) {
      PlaneLight::Triangles triangles = trianglesOf(v, polygon.normal);
      for (double& a : triangles.areas) a /= triangles.areas.back();
      if (!convex)  // the mean of its vertices may lie outside
        source.center = triangles.at(triangles.triangleAt(.5), .5, .5);
      light.map = std::move(triangles);
    } else {  // some samples miss the polygon
      light.map = PlaneLight::Square{};
      source.hitsWhereAimed = false;
    }
  }
  for (const V3d& p : v) source.radius = std::max(source.radius, (p - source.center).length());
  measure(light);
  source.shape = std::move(light);
  return source;
}

LightSource sourceOf(const Ring& ring, const Scene&) {
  PlaneLight light{.normal = ring.normal, .area = kPi * ring.outer * ring.outer, .map = PlaneLight::Disk{}};
  std::tie(light.u, light.v) = frame(ring.normal, ring.outer);
  measure(light);
  return {.center = ring.center, .radius = ring.outer, .shape = std::move(light)};
}

LightSource sourceOf(const Sphere& sphere, const Scene&) {
  return {.center = sphere.center,
          .radius = sphere.radius,
          .hitsWhereAimed = !sphere.inward,
          .shape = BallLight{}};
}

LightSource sourceOf(const Cone& cone, const Scene&) {
  const V3d half = cone.length / 2 * cone.axis;
  return {.center = cone.base + half,
          .radius = std::hypot(cone.length / 2, cone.radius0),
          .shape = TubeLight{half, 2 * cone.radius0 * cone.length}};
}

LightSource sourceOf(const Distant& distant, const Scene&) {
  const double sine = std::sin(distant.halfAngle);
  return {.center = distant.direction,
          .outermost = distant.cosHalfAngle > 0 ? sine : 1,
          .shape = DistantLight{sine, distant.cosHalfAngle}};
}

LightSource sourceOf(const NestedShape auto&, const Scene&) { return {}; }

}  // namespace

static_assert(kLightForms == 8, "How does rtrace split it?");
void measure(PlaneLight& light) {
  light.extentU = light.u.length();
  light.extentV = light.v.length();
  // A disk is split like the square of the same area, as in rtrace.
  if (std::holds_alternative<PlaneLight::Disk>(light.map))
    light.extentU = light.extentV = std::sqrt(light.area) / 2;
}

LightSource lightSourceOf(const Scene& scene, SurfaceId surface) {
  LightSource source =
      visit([&](const auto& shape) { return sourceOf(shape, scene); }, scene.surfaces[surface].shape);
  source.surface = surface;
  // A sensor is so small that the vertices of its square are not flat to rounding.
  if (scene.surfaces[surface].finish.sensor) source.hitsWhereAimed = true;
  if (!source.isDistant()) source.outermost = source.radius;
  return source;
}

bool canBeAimedAt(ShapeRef shape, const Scene& scene) {
  return match(
      shape,
      [&](const Polygon& polygon) {
        const auto v = std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices);
        constexpr size_t kMostCorners = 256;  // the number of triangles may grow with the square
        return isConvex(v, polygon.normal) ||
               (v.size() <= kMostCorners &&
                cover(trianglesOf(v, polygon.normal), areaOf(polygon, scene.vertices)));
      },
      [](const Ring& ring) { return ring.inner == 0; }, [](const Sphere& sphere) { return !sphere.inward; },
      [](const Cone& cone) { return !cone.inward && cone.radius0 == cone.radius1; },
      [](const Distant&) { return false; }, [](const NestedShape auto&) { return false; });
}

}  // namespace rsphere
