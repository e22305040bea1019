#include "transport/indirect_light.h"

#include <algorithm>
#include <cmath>

#include "transport/gather_directions.h"
#include "transport/radiance_guess.h"
#include "transport/ray_functions.h"
#include "transport/ray_limits.h"

namespace rsphere {

void IndirectLight::add(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  const RayOptions& o = t_.options();
  const PathContext& ray = end.context;
  if (o.ambientDivisions <= 0 || ray.ambientLevel >= o.ambientBounces || !t_.isAmbient(end.hit.surface)) {
    value += side.coefficient * o.ambientValue;
    return;
  }
  if (ray.depth == 0 && state_.request.leavesOutIndirect) {
    state_.leftOut.indirect = true;
    return;
  }
  if (state_.links) return link(end, side);
  const FirstBounce first = settings_.mode.firstBounce;
  if (ray.ambientLevel > 0 || first == FirstBounce::fromPatches ||
      (first == FirstBounce::gathered && (ray.kinds & kSpecular))) {
    if (settings_.caches.coarse && interpolated_.addFromPatch(end, side, value)) return;
  } else if (first == FirstBounce::interpolated && settings_.caches.field &&
             interpolated_.add(end, side, value)) {
    return;
  }
  gather(end, side, value);
}

// The number of guessed rays for each ray that is followed. It is 0 if -lr ends the descendants of the ray
// for certain instead of by Russian roulette: the guess would then include light that followed rays lack.
int IndirectLight::raysToGuess(const PathContext& ray) const {
  if (!state_.request.guess || !goesOn(t_, ray)) return 0;
  return state_.request.guess->raysToGuess(ray.ambientLevel);
}

// The number of directions of a gather. Paths that are to be unbiased have as many as RADIANCE gives them at
// every bounce: a square, in proportion to their weight. The rays of interpolated gathers are not divided.
int IndirectLight::raysOf(const PathContext& ray, const Coefficient& coefficient) const {
  if (state_.glimpses) return 1;
  const RayOptions& o = t_.options();
  const double asked = o.ambientDivisions + o.ambientSuperSamples,
               weighted = asked * std::min(ray.weight, 1.);
  if (settings_.caches.field) return ray.ambientLevel > 0 ? 1 : std::max(1, static_cast<int>(weighted + .5));
  // More directions than this would each fall below the weight limit, and most of them would end. The factor
  // .8 is RADIANCE's own.
  const double most =
      asked * .8 * maxChannel(coefficient) * ray.weight / (o.ambientDivisions * o.weightLimit + 1e-20);
  const int side = std::max(1, static_cast<int>(std::sqrt(std::min(weighted, most)) + .5));
  return side * side;
}

// Every ray that is followed may be corrected by a control variate: the guess of its radiance is subtracted,
// and the mean of many guesses added.
void IndirectLight::gather(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  const LocalGuess* const guess = state_.request.guess;
  const int rays = raysOf(end.context, side.coefficient), guesses = raysToGuess(end.context);
  const GatherDirections directions(settings_.aims, side.point, side.normal, side.trueNormal, rays);
  if (guesses > 0)
    directions.draw(rays * guesses, state_.random, [&](const V3d& direction, double part) {
      value += side.coefficient * part * guess->indirect(side.point, direction, end.hit.surface);
    });
  const Coefficient weight = settings_.caches.field ? Coefficient(kMeanReflectance) : side.coefficient / rays;
  sendOverHemisphere(t_, directions, state_, end, side.point, side.kind, rays, side.coefficient, weight,
                     [&](const NextRay& next) {
                       if (next.context.ambientLevel == 1) countDescendants(settings_, state_, next.context);
                       RayEnd seen(next.query, next.context);
                       value += follower_.follow(seen).value * next.coefficient;
                       if (guesses > 0) value -= guess->indirect(seen) * next.coefficient;
                     });
}

// What a ray of a patch finds at a diffuse surface: a link to the patch there. Where there is none, the path
// goes on in one direction, unless the last bounce is reached.
void IndirectLight::link(const RayEnd& end, const DiffuseSide& side) {
  PatchLinks& links = *state_.links;
  const int level = end.context.ambientLevel;
  const bool isLast = level >= bouncesBeyondPatches(t_.options());
  Patch* const patch = isLast ? nullptr : interpolated_.patchAt(end, side);
  const Coefficient whole = side.coefficient * end.context.contribution * passedBy(end);
  if (patch) return links.add(patch, whole, level - 1);
  links.addEnd(level - 1, whole);
  if (isLast) return;
  const GatherDirections directions(settings_.aims, side.point, side.normal, side.trueNormal, 1);
  sendOverHemisphere(t_, directions, state_, end, side.point, side.kind, 1, side.coefficient,
                     Coefficient(kMeanReflectance), [&](const NextRay& next) {
                       const Radiance found = follower_.follow(next.query, next.context).value;
                       links.addLight(level, found * next.context.contribution);
                     });
}

}  // namespace rsphere
