#include "transport/ray_limits.h"

#include <algorithm>
#include <cmath>

#include "transport/ray_functions.h"

namespace rsphere {

bool continueRay(const PreparedScene& prepared, Random& random, Ray& child, RayKind kind, const Ray& parent,
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
  if (o.reflectionLimit > 0) return child.weight >= o.weightLimit && child.level <= o.reflectionLimit;
  if (!(o.weightLimit > 0))
    throw rad::Error("zero ray weight in Russian roulette: -lw must be positive where -lr is not");
  if (o.reflectionLimit < 0 && child.level > -o.reflectionLimit) return false;
  if (child.weight >= o.weightLimit) return true;
  if (random.uniform() * o.weightLimit > child.weight) return false;
  coefficient *= o.weightLimit / child.weight;
  child.contribution *= o.weightLimit / child.weight;
  child.weight = o.weightLimit;
  return true;
}

}  // namespace rsphere
