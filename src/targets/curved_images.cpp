#include "targets/curved_images.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "light/surface_point.h"
#include "spots/ball_reflection.h"
#include "spots/tuning.h"
#include "targets/glints.h"
#include "targets/tuning.h"

namespace rsphere {

static_assert(kShapes == 8, "Does a new shape mirror openings?");
CurvedImages::CurvedImages(const TargetScene& from)
    : prepared_(from.tracing.prepared), openings_(from.tracing.aims.of<Openings>()) {
  const Scene& scene = prepared_.scene();
  for (const SpecialObject& object : from.objects) {
    const Material* material = scene.materialOf(scene.surfaces[object.surface]);
    const double reflectance = material ? mirroredShare(*material) : 0;
    if (!openings_ || object.several || !(reflectance > 0)) continue;
    const ShapeRef shape = shapeOf(scene, object);
    if (const auto* ball = shape.as<Sphere>(); ball && !ball->inward)
      mirrors_.push_back({ball->center, V3d(0, 0, 0), 0, ball->radius, reflectance});
    if (const auto* c = shape.as<Cone>(); c && !c->inward && c->radius0 == c->radius1)
      mirrors_.push_back({c->base, c->axis, c->length, c->radius0, reflectance});
  }
}

V3d CurvedImages::Mirror::nearestOnAxis(const V3d& place) const {
  return base + std::clamp((place - base).dot(axis), 0., length) * axis;
}

// In projection along the axis, the place is that on a circle. Its height follows from unrolling the
// cylinder, which makes the path straight.
SurfacePoint CurvedImages::Mirror::towards(const V3d& point, const V3d& place) const {
  const V3d from = point - base, to = place - base;
  const double fromHeight = from.dot(axis), toHeight = to.dot(axis);
  const V3d fromSide = from - fromHeight * axis, toSide = to - toHeight * axis;
  const V3d normal = mirroringNormal({.center = V3d(0, 0, 0), .radius = radius}, fromSide, toSide, false);
  const double near = (fromSide - radius * normal).length(), far = (toSide - radius * normal).length();
  const double height = fromHeight + near / (near + far) * (toHeight - fromHeight);
  return {base + std::clamp(height, 0., length) * axis + radius * normal, normal};
}

// Whether the point sees the middle of the opening, or the middle of one of its quarters.
bool CurvedImages::isVisible(const Mirror& mirror, const Opening& opening, const V3d& point) const {
  constexpr std::array<std::array<double, 2>, 5> kPlaces = {
      {{.5, .5}, {.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}}};
  const auto isClear = [&](const SurfacePoint& from, const V3d& to) {
    const V3d at = from.point + 2 * prepared_.tracer().samePlace() * from.normal, way = to - at;
    return way.dot(from.normal) > 0 &&
           prepared_.tracer().shadow(at, way.normalized(), way.length(), kNone) != Shadow::blocked;
  };
  return std::ranges::any_of(kPlaces, [&](const auto& uv) {
    const V3d place = opening.at(uv[0], uv[1]);
    const SurfacePoint at = mirror.towards(point, place);
    return opening.above(at.point) > 0 && isClear(at, point) && isClear(at, place);
  });
}

std::vector<FoundRegion> CurvedImages::find(const V3d& point, double usual) const {
  std::vector<FoundRegion> found;
  if (!(usual > 0)) return found;
  const double least = leastGlint(usual);
  for (const Mirror& mirror : mirrors_) {
    const double distance = (point - mirror.nearestOnAxis(point)).length() - mirror.radius;
    if (!(distance > 1e-4 * mirror.radius)) continue;
    // The image of a far object has about the solid angle of the object as seen from the mirror, times this;
    // in a ball, times its square.
    const double reduced = std::min(1., mirror.radius / (2 * distance));
    for (const Opening& opening : openings_->all()) {
      const V3d middle = opening.at(.5, .5);
      const double radiance = opening.radiance * mirror.reflectance;
      const double nearest = (middle - mirror.nearestOnAxis(middle)).length() - mirror.radius -
                             std::hypot(opening.width, opening.height) / 2;
      if (nearest > 0 && !(opening.area() / (nearest * nearest) * reduced * radiance * radiance > least))
        continue;
      std::array<V3d, 8> around;
      for (size_t i = 0; i < around.size(); ++i) {
        const std::array<V3d, 4> corners = opening.corners();
        const V3d edge = (corners[i / 2] + corners[(i + 1) / 2 % 4]) / 2;
        around[i] = mirror.towards(point, middle + tuning::Highlights::kWider * (edge - middle)).point;
      }
      Silhouette region = hullOf(around, point);
      if (region.regionSolidAngle() * radiance * radiance > least && isVisible(mirror, opening, point))
        found.push_back({std::move(region), tuning::Targets::kPartlyLit * radiance});
    }
  }
  return found;
}

}  // namespace rsphere
