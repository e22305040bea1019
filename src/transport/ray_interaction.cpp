#include "transport/ray_interaction.h"

namespace rsphere {
namespace {

// A ray is straight if its direction (unit) changed by less than this on its way through panes.
constexpr double kStraight = 1e-9;

// Whether a ray continues the primary ray in a straight line, except for its reflection by ray.mirror, and
// passes no surface that blocks shadow rays, so that shadow rays to the source reach it as well.
bool isStraight(const PreparedScene& t, const Ray& ray, const V3d& primaryDirection) {
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

void noteShown(const PreparedScene& t, const Ray& ray, PathState& state) {
  if (t.lightOf(ray.surface) == kNone) return;
  // The ray shows this source only if it came straight or was mirrored once. Behind a slab, such as thick glass, refraction
  // displaces the ray, which makes no difference to a distant source.
  const bool isDistant = t.scene().surfaces[ray.surface].shape.as<Distant>();
  const unsigned others = ray.kinds & ~(kPrimary | kTransmitted | (isDistant ? kRefracted : 0u));
  if (others != (ray.mirror == kNone ? 0u : kReflected)) return;
  if (state.shown.source != kNone && (state.shown.mirror == kNone || ray.mirror != kNone)) return;
  if (isStraight(t, ray, state.primaryDirection)) state.shown = {ray.surface, ray.mirror};
}

}  // namespace rsphere
