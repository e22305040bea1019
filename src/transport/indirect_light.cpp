#include "transport/indirect_light.h"

#include <algorithm>
#include <cmath>

#include "scene/even_sequence.h"
#include "transport/bright_spots.h"
#include "transport/hemisphere_rays.h"
#include "transport/radiance_guess.h"
#include "transport/ray_functions.h"
#include "transport/ray_limits.h"

namespace rsphere {
namespace {

// A hemisphere in side x side strata of equal projected solid angle. Some directions are aimed at bright
// spots instead of a stratum.
struct Strata {
  int side;
  V3d normal, trueNormal, x, y;
  const BrightSpots* spots;
  BrightSpots::Aim aim;

  Strata(const V3d& point, const V3d& hemisphere, const V3d& surface, int strata, const BrightSpots* aims)
      : side(strata), normal(hemisphere), trueNormal(surface), spots(aims) {
    frame(normal, x, y);
    if (spots) spots->aim(point, normal, aim);
  }

  // Draws a direction in the stratum (i, j) for uniform u1, u2, u3 in [0, 1); u3 decides whether it is aimed.
  // Returns its weight relative to a direction that is not aimed; 0 if it lies behind the surface.
  double draw(int i, int j, double u1, double u2, double u3, V3d& direction) const {
    if (u3 < aim.share) {
      direction = spots->sample(aim, u3 / aim.share, u1, u2);
    } else {
      // By projected solid angle, so that all directions have the same weight (Malley's method).
      const double radius = std::sqrt((i + u1) / side), angle = 2 * kPi * (j + u2) / side;
      const double height = std::sqrt(std::max(0., 1 - radius * radius));
      direction = radius * std::cos(angle) * x + radius * std::sin(angle) * y + height * normal;
    }
    const double cosine = direction.dot(normal);
    if (cosine <= 0 || direction.dot(trueNormal) <= 0) return 0;
    if (!(aim.share > 0)) return 1;
    return 1 / (1 - aim.share + aim.share * kPi / cosine * spots->density(aim, direction));
  }
};

}  // namespace

void IndirectLight::add(Ray& ray, const V3d& normal, const V3d& trueNormal, RayKind kind,
                        const Coefficient& coefficient) {
  const RayOptions& o = t_.options();
  if (o.ambientDivisions <= 0 || ray.ambientLevel >= o.ambientBounces || !t_.isAmbient(ray.surface)) {
    ray.value += coefficient * o.ambientValue;
    return;
  }
  const Surroundings at{normal, trueNormal, kind, coefficient};
  if (ray.ambientLevel > 0 && t_.coarse() && interpolated_.addFromPatch(ray, normal, trueNormal, coefficient))
    return;
  if (ray.ambientLevel == 0 && t_.field() && interpolated_.add(ray, normal, trueNormal, coefficient)) return;
  const int guesses = raysToGuess(ray);
  if (t_.field() && guesses == 0)
    gather(ray, at);
  else
    gatherStratified(ray, at, guesses);
}

// The number of guessed rays for each ray that is followed. It is 0 if -lr ends the descendants of the ray
// for certain instead of by Russian roulette: the guess would then include light that followed rays lack.
int IndirectLight::raysToGuess(const Ray& ray) const {
  const int limit = t_.options().reflectionLimit;
  if (!settings_.guess || limit > 0 || (limit < 0 && ray.level + 1 > -limit)) return 0;
  return settings_.guess->raysToGuess(ray.ambientLevel);
}

// Final gathering where neither the cache nor the coarse solution serves the ray.
void IndirectLight::gather(Ray& ray, const Surroundings& at) {
  const RayOptions& o = t_.options();
  const double rays =
      ray.ambientLevel > 0 ? 1 : (o.ambientDivisions + o.ambientSuperSamples) * std::min(ray.weight, 1.);
  sendOverHemisphere(t_, settings_.spots, state_.random, ray, at.normal, at.trueNormal, at.kind,
                     std::max(1, static_cast<int>(rays + .5)), [&](Ray& child, double part) {
                       const Coefficient c = at.coefficient * part;
                       child.contribution = ray.contribution * passedBy(ray) * c;
                       follower_.follow(child);
                       if (state_.links)
                         state_.links->addLight(child.ambientLevel - 1, child.value * child.contribution);
                       else
                         ray.value += child.value * c;
                     });
}

// The side of the square of strata at the first diffuse surface of a path; 1 at later ones.
int IndirectLight::strataOf(const Ray& ray, const Coefficient& coefficient) const {
  if (ray.ambientLevel > 0) return 1;
  const RayOptions& o = t_.options();
  double divisions = (o.ambientDivisions + o.ambientSuperSamples) * std::min(ray.weight, 1.);
  // More directions than this would each fall below the weight limit, and most of them would end. The factor
  // .8 is RADIANCE's own.
  if (!t_.field())
    divisions =
        std::min(divisions, (o.ambientDivisions + o.ambientSuperSamples) * .8 * maxChannel(coefficient) *
                                ray.weight / (o.ambientDivisions * o.weightLimit + 1e-20));
  return std::max(1, static_cast<int>(std::sqrt(divisions) + .5));
}

// Every followed ray may be corrected by a control variate: the guess of its radiance is subtracted, and the
// mean of several guesses added.
void IndirectLight::gatherStratified(Ray& ray, const Surroundings& at, int guesses) {
  Random& random = state_.random;
  const bool interpolating = t_.field() != nullptr;
  const Strata strata(ray.point, at.normal, at.trueNormal, strataOf(ray, at.coefficient), settings_.spots);
  const Coefficient share = at.coefficient / (static_cast<double>(strata.side) * strata.side);
  for (int i = 0; i < strata.side; ++i)
    for (int j = 0; j < strata.side; ++j) {
      if (guesses > 0) {
        const double shift3 = random.uniform(), shift1 = random.uniform(), shift2 = random.uniform();
        Radiance sum;
        for (int k = 0; k < guesses; ++k) {
          V3d direction;
          const Imath::V2d u = evenly(static_cast<size_t>(k), shift1, shift2);
          const double part = strata.draw(i, j, u.x, u.y, (k + shift3) / guesses, direction);
          if (part > 0) sum += part * settings_.guess->indirect(ray.point, direction, ray.surface);
        }
        ray.value += share * sum / static_cast<double>(guesses);
      }
      Ray child;
      const double u3 = strata.aim.share > 0 ? random.uniform() : 1;
      const double u1 = random.uniform(), u2 = random.uniform();
      const double part = strata.draw(i, j, u1, u2, u3, child.direction);
      if (!(part > 0)) continue;
      Coefficient c = interpolating ? Coefficient(kMeanReflectance) : share;
      if (!continueRay(t_, random, child, at.kind, ray, c)) continue;
      if (interpolating) c *= share / kMeanReflectance;
      // Only after roulette: an aimed direction has a small weight because it was chosen for being bright,
      // and must not be ended for that.
      c *= part;
      child.contribution = ray.contribution * passedBy(ray) * c;
      ++child.ambientLevel;
      follower_.follow(child);
      ray.value += child.value * c;
      if (guesses > 0) ray.value -= settings_.guess->indirect(child) * c;
    }
}

}  // namespace rsphere
