#include "transport/participating_media.h"

#include <algorithm>
#include <cmath>

#include "transport/ray_functions.h"

namespace rsphere {

Coefficient transmittanceOf(const Color& extinction, double length) {
  Color transmittance = extinction;
  transmittance.transform([&](double k) { return std::exp(-k * length); });
  return Coefficient(std::move(transmittance));
}
namespace {

constexpr int kMostSteps = 16;  // samples of one source along a ray; as in RADIANCE

// The Henyey-Greenstein phase function times 4 pi; isotropic for g <= 0, as in RADIANCE.
double phase(double g, double cosine) {
  if (g <= kNegligible) return 1;
  const double d = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (d * std::sqrt(d));
}

}  // namespace

void ParticipatingMedia::passThrough(Ray& ray) {
  const Medium& medium = ray.medium;
  const Coefficient passed = passedBy(ray);
  ray.value *= passed;
  if ((ray.kinds & kShadow) || !(maxChannel(medium.albedo) > kNegligible)) return;
  ray.value += Coefficient(medium.albedo) * t_.options().ambientValue * (Coefficient(1) - passed);
  addScattered(ray);
}

// Adds single scattering of the light from sources. It is sampled at one random point in each step (-ms)
// along the ray.
void ParticipatingMedia::addScattered(Ray& ray) {
  if (ray.scatterers.count == 0 || ray.length >= .99 * kFarAway || ray.medium.eccentricity >= 1 - kNegligible)
    return;
  const double stepLength = t_.options().mediumSampling;
  const int steps = stepLength > kNegligible
                        ? static_cast<int>(std::clamp(ray.length / stepLength + .5, 1., double{kMostSteps}))
                        : 1;
  // A ray that ends at the point of scattering.
  Ray at;
  at.direction = ray.direction;
  at.medium = ray.medium;
  at.scatterers = ray.scatterers;
  at.mist = ray.mist;
  at.kinds = 0;
  at.depth = ray.depth;
  at.pathLength = ray.pathLength;
  at.contribution = ray.contribution;
  at.cosine = 0;  // there is no surface, hence neither front nor back
  const Coefficient scattered(ray.medium.extinction * ray.medium.albedo * (ray.length / steps / (4 * kPi)));
  for (const uint16_t scatterer : ray.scatterers)
    for (int i = 0; i < steps; ++i) {
      at.length = ray.length * (i + state_.random.uniform()) / steps;
      const Coefficient passed = passing(ray.medium.extinction, at.length);
      if (maxChannel(passed) <= kNegligible * kNegligible) break;
      at.point = ray.origin + at.length * ray.direction;
      const auto coefficientOf = [&](const V3d& toSource, double solidAngle) {
        return scattered * passed *
               (solidAngle * phase(ray.medium.eccentricity, ray.direction.dot(toSource)));
      };
      direct_.addFromSource(at, t_.scatterers()[scatterer], coefficientOf, ray.value);
    }
}

}  // namespace rsphere
