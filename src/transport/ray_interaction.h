#pragma once
// The hit of a ray as materials and function files see it.
#include <cmath>

#include "shade/material_hit.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// REQUIRES that the ray hit a surface, except for interactionOf() and pointOf().
inline Arrival arrivalOf(const PreparedScene& t, const Ray& ray) {
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
inline Interaction interactionOf(const Scene& scene, const Ray& ray) {
  Interaction at;
  at.direction = ray.direction;
  const bool behind = ray.cosine < 0;
  at.normal = behind ? -ray.normal : ray.normal;
  at.cosine = std::abs(ray.cosine);
  at.front = behind == ray.fromBehind;
  at.perturbation = behind ? -ray.perturbation : ray.perturbation;
  at.pattern = ray.pattern;
  at.kinds = ray.kinds;
  if (ray.surface != kNone) {
    const Surface& surface = scene.surfaces[ray.surface];
    at.flat = surface.shape.as<Polygon>() || surface.shape.as<Ring>() || surface.shape.as<MeshFaces>();
    at.smoothed = surface.smoothed;
  }
  return at;
}

inline FunctionPoint pointOf(const Ray& ray) {
  FunctionPoint at;
  at.direction = ray.direction;
  at.normal = ray.normal;
  at.cosine = ray.cosine;
  at.point = ray.point;
  at.distance = ray.pathLength + ray.length;
  at.shadowDistance = ray.shadowLength + ray.length;
  at.u = ray.u;
  at.v = ray.v;
  at.path = ray.path;
  return at;
}

// Adds a light source that the ray shows to the state of its path, if the ray is one that shows sources
// (PathTracer::shown()). The ray hit a surface that emits light towards it.
void noteShown(const PreparedScene& prepared, const Ray& ray, PathState& state);

}  // namespace rsphere
