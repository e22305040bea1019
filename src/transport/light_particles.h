#pragma once
// Particles of light from the sources of a scene, each with the same power.
#include "light/sources.h"
#include "scene/random.h"
#include "trace/tracer.h"
#include "transport/function_ref.h"

namespace rsphere {

// Called for each emitted particle: its origin (world), direction (unit), power (W, of brightness) and the
// source's surface. `random` continues its stream of random numbers.
using SentParticle = FunctionRef<void(const V3d& origin, const V3d& direction, double power,
                                      const Surface& source, Random& random)>;

// The light that a real source sends out (W, of brightness). reach: half the extent of the scene (world
// units), within which distant sources shine.
double powerOf(const Scene& scene, const LightSource& light, double reach);

// Sends about `count` particles from all real sources, in proportion to their power. Those of distant sources
// start outside the scene. The same scene gives the same particles.
void sendParticles(const Scene& scene, const Tracer& tracer, const LightSources& lights, double count,
                   SentParticle each);

// A random direction (unit) on the front side, distributed like the light that a diffuse surface reflects.
V3d sentFrom(const V3d& normal, Random& random);

}  // namespace rsphere
