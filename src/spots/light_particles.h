#pragma once
// Particles that carry light from the sources of a scene, each with an equal part of the power.
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/frame.h"
#include "base/function_ref.h"
#include "base/random.h"
#include "light/sources.h"
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

}  // namespace rsphere
