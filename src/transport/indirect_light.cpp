#include "transport/indirect_light.h"

#include <algorithm>
#include <cmath>

#include "transport/gather_directions.h"
#include "transport/radiance_guess.h"
#include "transport/ray_functions.h"
#include "transport/ray_limits.h"

namespace rsphere {

void IndirectLight::add(Ray& ray, const V3d& normal, const V3d& trueNormal, RayKind kind,
                        const Coefficient& coefficient) {
  const RayOptions& o = t_.options();
  if (o.ambientDivisions <= 0 || ray.ambientLevel >= o.ambientBounces || !t_.isAmbient(ray.surface)) {
    ray.value += coefficient * o.ambientValue;
    return;
  }
  if (ray.depth == 0 && state_.request.leavesOutIndirect) {
    state_.leftOut.indirect = true;
    return;
  }
  const Side at{normal, trueNormal, kind, coefficient};
  if (state_.links) return link(ray, at);
  const FirstBounce first = settings_.mode.firstBounce;
  if (ray.ambientLevel > 0 || first == FirstBounce::fromPatches ||
      (first == FirstBounce::gathered && (ray.kinds & kSpecular))) {
    if (settings_.caches.coarse && interpolated_.addFromPatch(ray, normal, trueNormal, coefficient)) return;
  } else if (first == FirstBounce::interpolated && settings_.caches.field &&
             interpolated_.add(ray, normal, trueNormal, coefficient)) {
    return;
  }
  gather(ray, at);
}

// The number of guessed rays for each ray that is followed. It is 0 if -lr ends the descendants of the ray
// for certain instead of by Russian roulette: the guess would then include light that followed rays lack.
int IndirectLight::raysToGuess(const Ray& ray) const {
  if (!state_.request.guess || !goesOn(t_, ray)) return 0;
  return state_.request.guess->raysToGuess(ray.ambientLevel);
}

// The number of directions of a gather. Paths that are to be unbiased have as many as RADIANCE gives them at
// every bounce: a square, in proportion to their weight. The rays of interpolated gathers are not divided.
int IndirectLight::raysOf(const Ray& ray, const Coefficient& coefficient) const {
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
void IndirectLight::gather(Ray& ray, const Side& at) {
  const int rays = raysOf(ray, at.coefficient), guesses = raysToGuess(ray);
  const GatherDirections directions(settings_.aims, ray.point, at.normal, at.trueNormal, rays);
  if (guesses > 0)
    directions.draw(rays * guesses, state_.random, [&](const V3d& direction, double part) {
      ray.value += at.coefficient * part * state_.request.guess->indirect(ray.point, direction, ray.surface);
    });
  const Coefficient weight = settings_.caches.field ? Coefficient(kMeanReflectance) : at.coefficient / rays;
  sendOverHemisphere(t_, directions, state_, ray, at.kind, rays, at.coefficient, weight,
                     [&](Ray& child, const Coefficient& factor) {
                       if (child.ambientLevel == 1) countDescendants(settings_, state_, child);
                       follower_.follow(child);
                       ray.value += child.value * factor;
                       if (guesses > 0) ray.value -= state_.request.guess->indirect(child) * factor;
                     });
}

// What a ray of a patch finds at a diffuse surface: a link to the patch there. Where there is none, the path goes on in
// one direction, unless the last bounce is reached.
void IndirectLight::link(const Ray& ray, const Side& at) {
  PatchLinks& links = *state_.links;
  const int beyond = ray.ambientLevel - 1;
  const bool isLast = ray.ambientLevel >= bouncesBeyondPatches(t_.options());
  Patch* const patch = isLast ? nullptr : interpolated_.patchAt(ray, at.normal, at.trueNormal);
  const Coefficient whole = at.coefficient * ray.contribution * passedBy(ray);
  if (patch) return links.add(patch, whole, beyond);
  links.addEnd(beyond, whole);
  if (isLast) return;
  const GatherDirections directions(settings_.aims, ray.point, at.normal, at.trueNormal, 1);
  sendOverHemisphere(t_, directions, state_, ray, at.kind, 1, at.coefficient, Coefficient(kMeanReflectance),
                     [&](Ray& child, const Coefficient&) {
                       follower_.follow(child);
                       links.addLight(child.ambientLevel - 1, child.value * child.contribution);
                     });
}

}  // namespace rsphere
