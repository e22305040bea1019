#include "transport/interpolated_light.h"

#include <algorithm>
#include <cmath>

#include "transport/final_gather.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::Interpolation;

// Whether interpolated light is valid at a side. It was gathered in the whole scene, with nothing cut away by
// antimatter, and in the medium that fills the scene. Its moments do not tell the light at very tilted
// normals.
bool isOrdinary(const RayEnd& end, const DiffuseSide& side, const Medium& medium) {
  const RaySpace& space = end.space();
  return !space.mist && !end.context.clips && !end.clipsBeyond && !space.scatterers.count &&
         space.medium.extinction == medium.extinction &&
         !(side.normal.dot(side.trueNormal) < Tuning::kLeastUpright);
}

SurfacePlace placeOf(const RayEnd& end, const DiffuseSide& side) {
  return {side.point, side.trueNormal, end.hit.surface, &end.hit.path, end.hit.length};
}

// The diffuse bounces that the limits allow beyond the end of a ray.
int bouncesLeft(const RayOptions& o, const PathContext& ray) {
  int left = o.ambientBounces - ray.ambientLevel;
  if (o.reflectionLimit != 0) left = std::min(left, std::abs(o.reflectionLimit) - ray.level);
  if (o.reflectionLimit > 0)
    for (double weight = ray.weight / 2, n = 0; n < left; ++n, weight /= 2)
      if (weight < o.weightLimit) left = static_cast<int>(n);
  return std::max(left, 0);
}

}  // namespace

bool InterpolatedLight::add(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  // The light at an imagined point (-I) is not interpolated, because no other ray needs it.
  if (end.hit.surface == kNone || !isOrdinary(end, side, t_.medium())) return false;
  TracedFieldRays rays(t_, follower_, end.context.depth);
  GatheredLight light;
  if (!settings_.caches.field->find(placeOf(end, side), reader_, rays, light)) return false;
  value += side.coefficient * light.meanOfTilted(side.trueNormal, side.normal);
  return true;
}

bool InterpolatedLight::addFromPatch(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  Patch* const patch = patchAt(end, side);
  if (!patch) return false;
  TracedFieldRays rays(t_, follower_, end.context.depth);
  value += side.coefficient *
           Radiance(settings_.caches.coarse->light(*patch, bouncesLeft(t_.options(), end.context), rays));
  return true;
}

Patch* InterpolatedLight::patchAt(const RayEnd& end, const DiffuseSide& side) {
  const double u1 = state_.random.uniform(), u2 = state_.random.uniform();
  if (!isOrdinary(end, side, t_.medium())) return nullptr;
  TracedFieldRays rays(t_, follower_, end.context.depth);
  return settings_.caches.coarse->find(placeOf(end, side), u1, u2, rays);
}

void InterpolatedLight::endPath() {
  if (settings_.caches.field) settings_.caches.field->leave(reader_);
}

}  // namespace rsphere
