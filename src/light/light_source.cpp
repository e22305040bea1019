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

PlaneLight::Fan fanOf(std::span<const V3d> v) {
  PlaneLight::Fan fan{{}, {v.begin(), v.end()}};
  double sum = 0;
  for (size_t i = 2; i < v.size(); ++i) {
    sum += (v[i - 1] - v[0]).cross(v[i] - v[0]).length() / 2;
    fan.areas.push_back(sum);
  }
  for (double& a : fan.areas) a /= sum;
  return fan;
}

LightSource sourceOf(const Polygon& polygon, const Scene& scene) {
  const auto v = std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices);
  LightSource source;
  for (const V3d& p : v) source.center += p / static_cast<double>(v.size());
  for (const V3d& p : v) source.radius = std::max(source.radius, (p - source.center).length());
  source.hitsWhereAimed = isFlat(polygon, scene.vertices);
  PlaneLight light{.normal = polygon.normal, .area = areaOf(polygon, scene.vertices)};
  if (isParallelogram(v)) {
    light.u = (v[1] - v[0]) / 2;
    light.v = (v[3] - v[0]) / 2;
  } else {
    setSquare(light);
    if (isConvex(v, polygon.normal)) {
      light.map = fanOf(v);
    } else {  // some samples miss the polygon
      light.map = PlaneLight::Square{};
      source.hitsWhereAimed = false;
    }
  }
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
        return isConvex(std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices),
                        polygon.normal);
      },
      [](const Ring& ring) { return ring.inner == 0; }, [](const Sphere& sphere) { return !sphere.inward; },
      [](const Cone& cone) { return !cone.inward && cone.radius0 == cone.radius1; },
      [](const Distant&) { return false; }, [](const NestedShape auto&) { return false; });
}

}  // namespace rsphere
