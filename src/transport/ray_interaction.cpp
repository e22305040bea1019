#include "transport/ray_interaction.h"

#include <cmath>

namespace rsphere {
namespace {

// A ray is straight if its direction (unit) changed by less than this on its way through panes.
constexpr double kStraight = 1e-9;

// Whether a ray continues the primary ray in a straight line, except for its reflection by ray.mirror, and
// passes no surface that blocks shadow rays, so that shadow rays to the source reach it as well.
bool isStraight(const Transport& t, const Ray& ray, const V3d& primaryDirection) {
  for (const Ray* before = ray.parent; before; before = before->parent)
    if (before->surface != kNone && before->surface != ray.mirror &&
        t.tracer().stopsShadows(before->surface, before->cosine > 0))
      return false;
  V3d direction = primaryDirection;
  if (ray.mirror != kNone) {
    const V3d& normal = *planeNormal(t.scene().surfaces[ray.mirror].shape);
    direction -= 2 * normal.dot(direction) * normal;
  }
  return (ray.direction - direction).length2() < kStraight * kStraight;
}

}  // namespace

Interaction interactionOf(const Scene& scene, const Ray& ray) {
  Interaction at;
  at.direction = ray.direction;
  const bool behind = ray.cosine < 0;
  at.normal = behind ? -ray.normal : ray.normal;
  at.cosine = std::abs(ray.cosine);
  at.front = behind == ray.fromBehind;
  at.perturbation = behind ? -ray.perturbation : ray.perturbation;
  at.pattern = ray.pattern;
  at.kinds = ray.kinds;
  if (ray.surface != kNone) {
    const Surface& surface = scene.surfaces[ray.surface];
    at.flat = std::holds_alternative<Polygon>(surface.shape) || std::holds_alternative<Ring>(surface.shape) ||
              std::holds_alternative<MeshFaces>(surface.shape);
    at.smoothed = surface.smoothed;
  }
  return at;
}

FunctionPoint pointOf(const Ray& ray) {
  FunctionPoint at;
  at.direction = ray.direction;
  at.normal = ray.normal;
  at.cosine = ray.cosine;
  at.point = ray.point;
  at.distance = ray.pathLength + ray.length;
  at.shadowDistance = ray.shadowLength + ray.length;
  at.u = ray.u;
  at.v = ray.v;
  at.path = ray.path;
  return at;
}

void noteShown(const Transport& t, const Ray& ray, PathState& state) {
  // The ray shows this source only if it came straight or was mirrored once.
  const unsigned others = ray.kinds & ~(kPrimary | kTransmitted);
  if (t.lightOf(ray.surface) == kNone || others != (ray.mirror == kNone ? 0u : kReflected)) return;
  if (state.shown.source != kNone && (state.shown.mirror == kNone || ray.mirror != kNone)) return;
  if (isStraight(t, ray, state.primaryDirection)) state.shown = {ray.surface, ray.mirror};
}

}  // namespace rsphere
