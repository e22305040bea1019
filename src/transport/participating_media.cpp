#include "transport/participating_media.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

constexpr int kMostSteps = 16;  // samples of one source along a ray; as in RADIANCE

// The Henyey-Greenstein phase function times 4 pi; isotropic for g <= 0, as in RADIANCE.
double phase(double g, double cosine) {
  if (g <= kNegligible) return 1;
  const double d = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (d * std::sqrt(d));
}

}  // namespace

void ParticipatingMedia::passThrough(const RayEnd& end, Radiance& value) {
  const Medium& medium = end.medium();
  const Coefficient passed = passedBy(end);
  value *= passed;
  if ((end.context.kinds & kShadow) || !(maxChannel(medium.albedo) > kNegligible)) return;
  value += Coefficient(medium.albedo) * t_.options().ambientValue * (Coefficient(1) - passed);
  addScattered(end, value);
}

// Adds single scattering of light from the sources. Each step along the ray (-ms) is sampled at one random
// point.
void ParticipatingMedia::addScattered(const RayEnd& end, Radiance& value) {
  const Medium& medium = end.medium();
  const double length = end.hit.length;
  if (end.space().scatterers.count == 0 || length >= .99 * kFarAway || medium.eccentricity >= 1 - kNegligible)
    return;
  const double stepLength = t_.options().mediumSampling;
  const int steps = stepLength > kNegligible
                        ? static_cast<int>(std::clamp(length / stepLength + .5, 1., double{kMostSteps}))
                        : 1;
  // The ray from its origin to the point of scattering.
  const RayQuery query{.origin = V3d(0, 0, 0), .direction = end.ray.direction};
  const PathContext context{.kinds = 0,
                            .depth = end.context.depth,
                            .pathLength = end.context.pathLength,
                            .space = end.space(),
                            .contribution = end.context.contribution};
  RayEnd at(query, context);
  at.hit.cosine = 0;  // there is no surface, hence neither front nor back
  const Coefficient scattered(medium.extinction * medium.albedo * (length / steps / (4 * kPi)));
  for (const uint16_t scatterer : end.space().scatterers)
    for (int i = 0; i < steps; ++i) {
      at.hit.length = length * (i + state_.random.uniform()) / steps;
      const Coefficient passed = passing(medium.extinction, at.hit.length);
      if (maxChannel(passed) <= kNegligible * kNegligible) break;
      at.hit.point = end.ray.origin + at.hit.length * end.ray.direction;
      const auto coefficientOf = [&](const V3d& toSource, double solidAngle) {
        return scattered * passed *
               (solidAngle * phase(medium.eccentricity, end.ray.direction.dot(toSource)));
      };
      direct_.addFromSource(at, t_.lights().ofMists().all()[scatterer], coefficientOf, value);
    }
}

}  // namespace rsphere
