#include "targets/daylight_targets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "light/surface_point.h"
#include "spots/ball_reflection.h"
#include "spots/tuning.h"
#include "targets/glints.h"
#include "targets/special_targets.h"
#include "targets/tuning.h"

namespace rsphere {

OpeningTargets::OpeningTargets(const TargetScene& scene) {
  const Openings* const openings = scene.tracing.aims.of<Openings>();
  if (!openings) return;
  for (const Opening& opening : openings->all())
    if (std::ranges::none_of(scene.objects, [&](const SpecialObject& object) {
          return liesIn(scene.tracing.prepared.scene(), object, opening);
        }))
      openings_.push_back(opening);
}

std::vector<FoundRegion> OpeningTargets::find(const V3d& point, double) const {
  std::vector<FoundRegion> found;
  for (const Opening& o : openings_)
    if (o.above(point) > 0)
      found.push_back({hullOf(o.corners(), point), tuning::Targets::kPartlyLit * o.radiance, o.radiance});
  return found;
}

namespace {

// The middle of an opening, and those of its quarters, as shares of its sides.
constexpr std::array<std::array<double, 2>, 5> kPlaces = {
    {{.5, .5}, {.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}}};
// A line to a place on a surface ends before that place by this fraction of its length.
constexpr double kEnd = 1e-6;

// Whether the point sees the image at one of kPlaces.
bool isVisible(const PreparedScene& prepared, const OpeningImage& image, const Silhouette& region,
               const V3d& point) {
  const Tracer& tracer = prepared.tracer();
  const V3d& normal = image.mirror.normal;
  bool tested = false;
  for (const auto& [u, v] : kPlaces) {
    const V3d place = image.at(u, v), direction = (place - point).normalized();
    if (!region.contains(direction) || !(image.mirror.above(place) < 0)) continue;
    tested = true;
    const V3d at = image.crossing(point, place);
    const V3d back = place - 2 * image.mirror.above(place) * normal - at;
    if (tracer.shadow(point, direction, (at - point).length() * (1 - kEnd), kNone, nullptr, kInSpace) !=
            Shadow::blocked &&
        tracer.shadow(at + tracer.samePlace() * normal, back.normalized(), back.length() * (1 - kEnd),
                      kNone) != Shadow::blocked)
      return true;
  }
  return !tested;
}

// The corners of a box, without duplicates: the box around a flat surface is flat.
std::vector<V3d> cornersOf(const Box3d& box) {
  constexpr double kFlat = 1e-6;  // of the diagonal; the rest is rounding
  std::vector<V3d> corners{box.min};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.size()[axis] > kFlat * box.size().length())) continue;
    for (size_t i = 0, n = corners.size(); i < n; ++i) {
      corners.push_back(corners[i]);
      corners.back()[axis] = box.max[axis];
    }
  }
  return corners;
}

bool isVisible(const Tracer& tracer, const BrightSpots::Sunlit& spot, const V3d& point) {
  return std::ranges::any_of(spot.places, [&](const V3d& place) {
    const V3d way = place - point;
    const double distance = way.length();
    return way.dot(spot.normal) < 0 && tracer.shadow(point, way / distance, distance * (1 - kEnd), kNone,
                                                     nullptr, kInSpace) != Shadow::blocked;
  });
}

}  // namespace

std::vector<FoundRegion> MirroredOpenings::find(const V3d& point, double usual) const {
  std::vector<FoundRegion> found;
  if (!images_ || !(usual > 0)) return found;
  const Scene& scene = prepared_.scene();
  const double least = leastGlint(usual);
  for (const OpeningImage& image : images_->all()) {
    if (!(image.mirror.above(point) > 0) || !(image.above(point) > 0)) continue;
    const double square = image.radiance * image.radiance;
    const double nearest = (image.at(.5, .5) - point).length() - std::hypot(image.width, image.height) / 2;
    if (nearest > 0 && !(image.area() / (nearest * nearest) * square > least)) continue;
    Silhouette region = hullOf(image.corners(), point)
                            .within(silhouetteOf(scene.surfaces[image.surface].shape, scene.vertices, point));
    if (!(region.regionSolidAngle() * square > least) || !isVisible(prepared_, image, region, point))
      continue;
    found.push_back({std::move(region), tuning::Targets::kPartlyLit * image.radiance});
  }
  return found;
}

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

// Whether the point sees the opening at one of kPlaces.
bool CurvedImages::isVisible(const Mirror& mirror, const Opening& opening, const V3d& point) const {
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

SunlitTargets::SunlitTargets(const TargetScene& scene) : tracer_(scene.tracing.prepared.tracer()) {
  if (const auto* const spots = scene.tracing.aims.of<BrightSpots>()) spots_ = spots->sunlit();
}

std::vector<FoundRegion> SunlitTargets::find(const V3d& point, double usual) const {
  std::vector<FoundRegion> found;
  for (const BrightSpots::Sunlit& spot : spots_)
    if (const double deviation = tuning::Targets::kPartlyLit * spot.radiance;
        deviation > usual && isVisible(tracer_, spot, point))
      found.push_back({hullOf(cornersOf(spot.box), point), deviation});
  return found;
}

}  // namespace rsphere
