#pragma once
// The hit of a ray as materials and function files see it.
#include "shade/material_hit.h"
#include "transport/path_state.h"
#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

// REQUIRES that the ray hit a surface, except for interactionOf() and pointOf().
Arrival arrivalOf(const Transport& transport, const Ray& ray);
// With the patterns and textures that were applied to the ray so far.
Interaction interactionOf(const Scene& scene, const Ray& ray);
FunctionPoint pointOf(const Ray& ray);

// Adds a light source that the ray shows to the state of its path, if the ray is one that shows sources
// (PathTracer::shown()). The ray hit a surface that emits light towards it.
void noteShown(const Transport& transport, const Ray& ray, PathState& state);

}  // namespace rsphere
