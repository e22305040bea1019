#pragma once
// Particles that carry light from the sources of a scene, each with an equal part of the power.
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/frame.h"
#include "base/function_ref.h"
#include "base/random.h"
#include "light/sources.h"
#include "light/surface_point.h"
#include "shade/scattering.h"
#include "shade/surface_functions.h"
#include "trace/tracer.h"

namespace rsphere {

// Called for each emitted particle: its origin (world), direction (unit), power (W, of brightness) and the
// source's surface. `random` continues its stream of random numbers.
using SentParticle = FunctionRef<void(const V3d& origin, const V3d& direction, double power,
                                      const Surface& source, Random& random)>;

// The power of a real source (W, of brightness). reach: half the diagonal of the scene's bounds (world
// units). The power of a distant source is the power that enters a disk with this radius.
double powerOf(const Scene& scene, const LightSource& light, double reach);

// Sends about `count` particles from all real sources; the number from each source is proportional to its
// power. Spotlights send theirs within the cone, and sources with patterns, such as the light distribution of
// a luminaire, where they are bright. Particles of distant sources start outside the scene. The particles
// depend only on the scene.
void sendParticles(const Scene& scene, const Tracer& tracer, const LightSources& lights,
                   const SurfaceFunctions& functions, double count, SentParticle each);

// Whether `modifier` and all modifiers after it are patterns that satisfy isOfKind. Errors are ignored here,
// and reported when a ray hits the pattern.
template <class IsOfKind>
bool arePatterns(const Scene& scene, ModifierId modifier, const IsOfKind& isOfKind) {
  for (; modifier != kNone; modifier = scene.modifiers[modifier].next) {
    if (!std::holds_alternative<Pattern>(scene.modifiers[modifier].content)) return false;
    try {
      if (!isOfKind(modifier)) return false;
    } catch (const rad::Error&) {
      return false;
    }
  }
  return true;
}

// The product of the patterns of a source, for a ray of this direction (unit) that hits a point on it.
// normal: of its front there (unit).
inline Color patternOfSource(const SurfaceFunctions& functions, ModifierId patterns, const V3d& point,
                             const V3d& normal, const V3d& direction, FunctionScratch& scratch) {
  const FunctionPoint here{
      .direction = direction, .normal = normal, .cosine = -normal.dot(direction), .point = point};
  return functions.patterns(patterns, here, scratch);
}

// A random direction (unit) on the front side, distributed like diffusely reflected light.
template <class Numbers>
V3d sentFrom(const V3d& normal, Numbers& random) {
  const double u1 = random.uniform(), u2 = random.uniform();
  return diffuseDirection(normal, u1, u2);
}

// A random direction (unit), uniform within a cone of this solid angle (sr).
template <class Numbers>
V3d withinCone(const V3d& axis, double solidAngle, Numbers& random) {
  const double height = 1 - random.uniform() * solidAngle / (2 * kPi), angle = 2 * kPi * random.uniform();
  const double r = std::sqrt(std::max(0., 1 - height * height));
  const auto [x, y] = frame(axis);
  return height * axis + r * (std::cos(angle) * x + std::sin(angle) * y);
}

// A place on a source that is not distant, and a direction (unit) in which light leaves it.
struct LampWay {
  SurfacePoint from;
  V3d direction{0, 0, 1};
  double weight = 1;  // density of a diffuse emitter's light, divided by the density of ways
};

// A random way: of a spotlight, within its cone.
template <class Numbers>
LampWay wayFrom(const Scene& scene, const LightSource& light, Numbers& random) {
  LampWay way{samplePoint(light, scene, random)};
  if (light.spot) {
    way.direction = withinCone(light.spot->aim, light.spot->solidAngle, random);
    way.weight = std::max(0., way.from.normal.dot(way.direction)) * light.spot->solidAngle / kPi;
  } else {
    way.direction = sentFrom(way.from.normal, random);
  }
  return way;
}

}  // namespace rsphere
