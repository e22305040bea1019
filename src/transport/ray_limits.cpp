#include "transport/ray_limits.h"

#include <algorithm>
#include <cmath>

#include "transport/ray_functions.h"

namespace rsphere {
namespace {

// The weight below which descendants are followed by Russian roulette. It grows faster than the number of rays
// that do not lead to the child, so that their number has a bound even where the children of a ray have more
// weight than the ray. The child's own ancestors are left out: a path that does not split goes on.
double leastWeight(const Descendants& descendants, const Ray& child) {
  const int others = descendants.rays - (child.depth - descendants.depth);
  const double tooMany = (others - descendants.most) / descendants.most;
  return tooMany > 0 ? descendants.weight * tooMany * tooMany : 0;
}

// Adds the child to the descendants unless Russian roulette ends it.
bool addDescendant(PathState& state, Ray& child, Coefficient& coefficient) {
  if (const double least = leastWeight(state.descendants, child); least > 0)
    if (!survives(state.random, least, child, coefficient)) return false;
  ++state.descendants.rays;
  return true;
}

// Whether a child goes on in spite of the limits of reflections and weight (-lr, -lw).
bool isWithinLimits(const RayOptions& o, Random& random, Ray& child, Coefficient& coefficient) {
  if (o.reflectionLimit > 0) return child.weight >= o.weightLimit && child.level <= o.reflectionLimit;
  if (!(o.weightLimit > 0))
    throw rad::Error("zero ray weight in Russian roulette: -lw must be positive where -lr is not");
  if (o.reflectionLimit < 0 && child.level > -o.reflectionLimit) return false;
  return survives(random, o.weightLimit, child, coefficient);
}

}  // namespace

bool continueRay(const PreparedScene& prepared, PathState& state, Ray& child, RayKind kind, const Ray& parent,
                 Coefficient& coefficient) {
  const RayOptions& o = prepared.options();
  inherit(child, parent, kind);
  if (kind & kReflections) {
    ++child.level;
    child.farthest = 0;
    if (kind == kReflected && !(parent.kinds & ~(kPrimary | kTransmitted)) && parent.surface != kNone &&
        parent.surface.index() < prepared.scene().outermost().size() &&
        planeNormal(prepared.scene().surfaces[parent.surface].shape))
      child.mirror = parent.surface;
  } else {
    child.mirror = parent.mirror;
    child.aimedAt = parent.aimedAt;
    child.farthest = parent.farthest > kSamePlace ? parent.farthest - parent.length : 0;
  }
  child.contribution *= coefficient;
  child.weight = parent.weight * std::min(1., maxChannel(coefficient));
  const double depth = minChannel(parent.medium.extinction) * parent.length;
  // RADIANCE's own limit: a thinner medium does not reduce the weight.
  if (depth > .1) child.weight *= std::exp(-depth);
  if (!(child.weight > 0)) return false;
  if (child.kinds & kShadow) return true;
  if (!isWithinLimits(o, state.random, child, coefficient)) return false;
  const Descendants& descendants = state.descendants;
  const bool limited = descendants.most > 0 && parent.ambientLevel >= descendants.ambientLevel;
  return !limited || addDescendant(state, child, coefficient);
}

bool asksForPatch(PathState& state, const Ray& ray, Coefficient& coefficient) {
  using Tuning = tuning::RayLimits;
  Descendants& descendants = state.descendants;
  const bool ofPatch = state.links;
  const int freely = ofPatch ? Tuning::kAskedByPatch : Tuning::kAsked;
  if (!(descendants.most > 0) || ++descendants.patches <= freely) return true;
  const double further = ofPatch ? Tuning::kFurtherByPatch : Tuning::kFurther;
  const double probability = further * ray.weight * maxChannel(coefficient) / descendants.weight;
  if (probability >= 1) return true;
  if (state.random.uniform() >= probability) return false;
  coefficient /= probability;
  return true;
}

}  // namespace rsphere
