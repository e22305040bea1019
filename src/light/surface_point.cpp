#include "light/surface_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/frame.h"
#include "base/overloaded.h"

namespace rsphere {

template <class Numbers>
V3d uniformDirection(Numbers& random) {
  const double z = 1 - 2 * random.uniform(), angle = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(std::max(0., 1 - z * z));
  return V3d(r * std::cos(angle), r * std::sin(angle), z);
}

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// A thousandth of the shape's size.
double clearanceOf(double size) { return size * 1e-3; }

template <class Numbers>
SurfacePoint pointOn(const Polygon& polygon, std::span<const V3d> all, Numbers& random) {
  const auto v = all.subspan(polygon.firstVertex, polygon.vertices);
  const double area = areaOf(polygon, all);
  double left = random.uniform() * 2 * area;
  size_t i = 2;
  for (; i + 1 < v.size(); ++i) {
    left -= (v[i - 1] - v[0]).cross(v[i] - v[0]).length();
    if (left < 0) break;
  }
  const double root = std::sqrt(random.uniform()), t = random.uniform();
  return {(1 - root) * v[0] + root * (1 - t) * v[i - 1] + root * t * v[i], polygon.normal,
          clearanceOf(std::sqrt(area))};
}

template <class Numbers>
SurfacePoint pointOn(const Sphere& sphere, std::span<const V3d>, Numbers& random) {
  const V3d out = uniformDirection(random);
  return {sphere.center + sphere.radius * out, sphere.inward ? -out : out, clearanceOf(sphere.radius)};
}

template <class Numbers>
SurfacePoint pointOn(const Cone& cone, std::span<const V3d>, Numbers& random) {
  const auto [x, y] = frame(cone.axis);
  const double s = random.uniform(), angle = kTwoPi * random.uniform();
  const V3d out = std::cos(angle) * x + std::sin(angle) * y;
  const double slope = (cone.radius1 - cone.radius0) / cone.length;
  const V3d normal = (out - slope * cone.axis) / std::sqrt(1 + slope * slope);
  return {cone.base + s * cone.length * cone.axis + (cone.radius0 + s * (cone.radius1 - cone.radius0)) * out,
          cone.inward ? -normal : normal, clearanceOf(std::max(cone.radius0, cone.radius1))};
}

template <class Numbers>
SurfacePoint pointOn(const Ring& ring, std::span<const V3d>, Numbers& random) {
  const auto [x, y] = frame(ring.normal);
  const double inner = ring.inner * ring.inner, outer = ring.outer * ring.outer;
  const double r = std::sqrt(inner + random.uniform() * (outer - inner)), angle = kTwoPi * random.uniform();
  return {ring.center + r * std::cos(angle) * x + r * std::sin(angle) * y, ring.normal,
          clearanceOf(ring.outer)};
}

}  // namespace

template <class Numbers>
SurfacePoint samplePoint(ShapeRef shape, std::span<const V3d> vertices, Numbers& random) {
  return match(
      shape, [&](const PlainShape auto& form) { return pointOn(form, vertices, random); },
      [](const Distant&) { return SurfacePoint{}; }, [](const NestedShape auto&) { return SurfacePoint{}; });
}

static_assert(kLightForms == 8, "Can it be concave?");
template <class Numbers>
SurfacePoint samplePoint(const LightSource& source, const Scene& scene, Numbers& random) {
  const auto* const plane = source.as<PlaneLight>();
  const auto* const triangles = plane ? std::get_if<PlaneLight::Triangles>(&plane->map) : nullptr;
  if (!triangles) return samplePoint(scene.surfaces[source.surface].shape, scene.vertices, random);
  const size_t i = triangles->triangleAt(random.uniform());
  const double s = random.uniform();
  return {triangles->at(i, s, random.uniform()), plane->normal, clearanceOf(std::sqrt(plane->area))};
}

template V3d uniformDirection(Random&);
template V3d uniformDirection(ScrambledPoint&);
template SurfacePoint samplePoint(ShapeRef, std::span<const V3d>, Random&);
template SurfacePoint samplePoint(ShapeRef, std::span<const V3d>, ScrambledPoint&);
template SurfacePoint samplePoint(const LightSource&, const Scene&, Random&);
template SurfacePoint samplePoint(const LightSource&, const Scene&, ScrambledPoint&);

}  // namespace rsphere
