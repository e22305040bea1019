#include "transport/ray_limits.h"

#include <cmath>

#include "rays/ray_functions.h"

namespace rsphere {
namespace {

// The weight below which descendants are subject to Russian roulette. It grows faster than the number of
// descendants, which is therefore bounded even if children have larger weights than their parents. The
// ancestors of the new ray are not counted, so that a path without branches continues.
double leastWeight(const Descendants& descendants, const PathContext& child) {
  const int others = descendants.rays - (child.depth - descendants.depth);
  const double tooMany = (others - descendants.most) / descendants.most;
  return tooMany > 0 ? descendants.weight * tooMany * tooMany : 0;
}

// Adds a ray to the descendants, unless Russian roulette ends it.
bool addDescendant(PathState& state, NextRay& next) {
  if (const double least = leastWeight(state.descendants, next.context); least > 0)
    if (!survives(state.random, least, next)) return false;
  ++state.descendants.rays;
  return true;
}

// Whether a ray may continue according to the limits on reflections and weight (-lr, -lw).
bool isWithinLimits(const RayOptions& o, Random& random, NextRay& next) {
  const PathContext& ray = next.context;
  if (o.reflectionLimit > 0) return ray.weight >= o.weightLimit && ray.level <= o.reflectionLimit;
  if (!(o.weightLimit > 0))
    throw rad::Error("zero ray weight in Russian roulette: -lw must be positive where -lr is not");
  if (o.reflectionLimit < 0 && ray.level > -o.reflectionLimit) return false;
  return survives(random, o.weightLimit, next);
}

// Sets the data that differ between a reflected ray and one that continues beyond the surface.
void turnOrGoOn(const Scene& scene, NextRay& next) {
  const RayEnd& parent = *next.context.parent;
  const RayKind kind = next.context.kind;
  if (!(kind & kReflections)) {
    next.context.mirror = parent.context.mirror;
    next.query.aimedAt = parent.ray.aimedAt;
    if (parent.ray.farthest > scene.samePlace) next.query.farthest = parent.ray.farthest - parent.hit.length;
    return;
  }
  ++next.context.level;
  const SurfaceId at = parent.hit.surface;
  if (kind == kReflected && !(parent.context.kinds & ~(kPrimary | kTransmitted)) && at != kNone &&
      at.index() < scene.outermost().size() && planeNormal(scene.surfaces[at].shape))
    next.context.mirror = at;
}

}  // namespace

bool goesOnAlong(NextRay& next, const PreparedScene& prepared, PathState& state) {
  turnOrGoOn(prepared.scene(), next);
  PathContext& ray = next.context;
  const RayEnd& parent = *ray.parent;
  ray.contribution *= next.coefficient;
  ray.weight = parent.context.weight * std::min(1., maxChannel(next.coefficient));
  const double depth = minChannel(parent.medium().extinction) * parent.hit.length;
  // As in RADIANCE, a thinner medium does not reduce the weight.
  if (depth > .1) ray.weight *= std::exp(-depth);
  if (!(ray.weight > 0)) return false;
  if (ray.kinds & kShadow) return true;
  if (!isWithinLimits(prepared.options(), state.random, next)) return false;
  const Descendants& descendants = state.descendants;
  const bool limited = descendants.most > 0 && parent.context.ambientLevel >= descendants.ambientLevel;
  return !limited || addDescendant(state, next);
}

bool asksForPatch(PathState& state, const PathContext& ray, Coefficient& coefficient) {
  Descendants& descendants = state.descendants;
  const bool ofPatch = state.links;
  const int freely = ofPatch ? tuning::RayLimits::kAskedByPatch : tuning::RayLimits::kFreely;
  if (!(descendants.most > 0) || ++descendants.patches <= freely) return true;
  const double further = ofPatch ? tuning::RayLimits::kAskedByPatch : tuning::RayLimits::kFurther;
  const double probability = further * ray.weight * maxChannel(coefficient) / descendants.weight;
  if (probability >= 1) return true;
  if (state.random.uniform() >= probability) return false;
  coefficient /= probability;
  return true;
}

}  // namespace rsphere
