#pragma once
// The hit of a ray as materials and function files see it.
#include "shade/material_hit.h"
#include "transport/path_state.h"
#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

// REQUIRES that the ray hit a surface, except for interactionOf() and pointOf().
inline Arrival arrivalOf(const Transport& t, const Ray& ray) {
  Arrival a;
  a.kinds = ray.kinds;
  a.cosine = ray.cosine;
  a.length = ray.length;
  a.pathLength = ray.pathLength;
  a.surface = ray.surface;
  if (ray.aimedAt != kNone) {
    const LightSource& target = t.lights().all()[ray.aimedAt];
    a.target = target.surface;
    a.atImage = target.isVirtual();
    a.image = target.image;
  }
  return a;
}

// With the patterns and textures that were applied to the ray so far.
Interaction interactionOf(const Scene& scene, const Ray& ray);
FunctionPoint pointOf(const Ray& ray);

// Adds a light source that the ray shows to the state of its path, if the ray is one that shows sources
// (PathTracer::shown()). The ray hit a surface that emits light towards it.
void noteShown(const Transport& transport, const Ray& ray, PathState& state);

}  // namespace rsphere
