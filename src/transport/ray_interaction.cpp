#include "transport/ray_interaction.h"

namespace rsphere {
namespace {

// A ray is straight if its direction (unit) changed by less than this on its way through panes.
constexpr double kStraight = 1e-9;

// Whether a ray continues the primary ray in a straight line, except for its reflection by
// PathContext::mirror, and passes no surface that blocks shadow rays, so that shadow rays to the source reach
// it as well.
bool isStraight(const PreparedScene& t, const RayEnd& end, const V3d& primaryDirection) {
  const SurfaceId mirror = end.context.mirror;
  for (const RayEnd* before = end.context.parent; before; before = before->context.parent) {
    const SurfaceHit& hit = before->hit;
    if (hit.surface != kNone && hit.surface != mirror && t.tracer().stopsShadows(hit.surface, hit.cosine > 0))
      return false;
  }
  V3d direction = primaryDirection;
  if (mirror != kNone) {
    const V3d& normal = *planeNormal(t.scene().surfaces[mirror].shape);
    direction -= 2 * normal.dot(direction) * normal;
  }
  return (end.ray.direction - direction).length2() < kStraight * kStraight;
}

}  // namespace

void noteShown(const PreparedScene& t, const RayEnd& end, PathState& state) {
  const SurfaceId surface = end.hit.surface, mirror = end.context.mirror;
  if (t.lightOf(surface) == kNone) return;
  // The ray shows this source only if it came straight or was mirrored once. Behind a slab, such as thick
  // glass, refraction displaces the ray, which makes no difference to a distant source.
  const bool isDistant = t.scene().surfaces[surface].shape.as<Distant>();
  const unsigned others = end.context.kinds & ~(kPrimary | kTransmitted | (isDistant ? kRefracted : 0u));
  if (others != (mirror == kNone ? 0u : kReflected)) return;
  if (state.shown.source != kNone && (state.shown.mirror == kNone || mirror != kNone)) return;
  if (isStraight(t, end, state.primaryDirection)) state.shown = {surface, mirror};
}

}  // namespace rsphere
