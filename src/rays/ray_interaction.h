#pragma once
// Converts the end of a ray to the data that materials and function files need.
#include <cmath>

#include "rays/prepared_scene.h"
#include "rays/ray.h"
#include "shade/material_hit.h"

namespace rsphere {

// REQUIRES, except for interactionOf() and pointOf(), that the ray hit a surface.
inline Arrival arrivalOf(const PreparedScene& t, const RayEnd& end) {
  Arrival a;
  a.kinds = end.context.kinds;
  a.cosine = end.hit.cosine;
  a.length = end.hit.length;
  a.pathLength = end.context.pathLength;
  a.surface = end.hit.surface;
  if (end.ray.aimedAt != kNone) {
    const LightSource& target = t.lights().all()[end.ray.aimedAt];
    a.target = target.surface;
    a.atImage = target.isVirtual();
    a.image = target.image;
  }
  return a;
}

// Includes the patterns and textures that have been applied so far.
inline Interaction interactionOf(const Scene& scene, const RayEnd& end) {
  const SurfaceHit& hit = end.hit;
  Interaction at;
  at.direction = end.ray.direction;
  const bool behind = hit.cosine < 0;
  at.normal = behind ? -hit.normal : hit.normal;
  at.cosine = std::abs(hit.cosine);
  at.front = behind == hit.fromBehind;
  at.perturbation = behind ? -hit.perturbation : hit.perturbation;
  at.pattern = hit.pattern;
  at.kinds = end.context.kinds;
  if (hit.surface != kNone) {
    const Surface& surface = scene.surfaces[hit.surface];
    at.flat = isFlat(surface.shape);
    at.smoothed = surface.smoothed;
  }
  return at;
}

inline FunctionPoint pointOf(const RayEnd& end) {
  const SurfaceHit& hit = end.hit;
  FunctionPoint at;
  at.direction = end.ray.direction;
  at.normal = hit.normal;
  at.cosine = hit.cosine;
  at.point = hit.point;
  at.distance = end.context.pathLength + hit.length;
  at.shadowDistance = end.context.shadowLength + hit.length;
  at.u = hit.u;
  at.v = hit.v;
  at.path = hit.path;
  return at;
}

}  // namespace rsphere
