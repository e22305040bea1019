#pragma once
// Constants and small functions of rays that the parts of PathTracer share.
#include <cmath>

#include "base/constants.h"
#include "scene/material.h"
#include "transport/ray.h"

namespace rsphere {

// A diffuse material of reflectance pi. Its radiance is pi times the mean incident radiance, which is the
// irradiance (-i, -I).
inline const Opaque kIrradianceMeter{Color(kPi, kPi, kPi), 0, 0, false};

// The apparent distance of the object seen along the ray: that of the mirrored image if it gives more than
// half of the light.
inline double apparentLength(const Ray& ray) {
  return brightness(ray.mirrored) > .5 * brightness(ray.value) ? ray.mirroredLength : ray.unmirroredLength;
}

// Whether the extinction is large enough to matter over a distance of kFarAway.
inline bool isMedium(const Color& extinction) { return maxChannel(extinction) > 1 / kFarAway; }

// The transmittance of a medium. extinction: per unit length.
Coefficient transmittanceOf(const Color& extinction, double length);
inline Coefficient passing(const Color& extinction, double length) {
  return isMedium(extinction) ? transmittanceOf(extinction, length) : Coefficient(1);
}

// The transmittance of the medium along a ray. Shadow rays are attenuated by absorption alone: it is assumed
// that in-scattering replaces the light that is scattered out of them.
inline Coefficient passedBy(const Ray& ray) {
  const Medium& medium = ray.medium;
  if (!isMedium(medium.extinction)) return Coefficient(1);
  const bool scatteredIn = (ray.kinds & kShadow) != 0;
  return passing(scatteredIn ? medium.extinction * (Color(1, 1, 1) - medium.albedo) : medium.extinction,
                 ray.length);
}

// Sets the fields that a child has from its parent, whatever its kind.
inline void inherit(Ray& child, const Ray& parent, RayKind kind) {
  child.parent = &parent;
  child.origin = parent.point;
  child.kind = kind;
  child.kinds = parent.kinds | kind;
  child.level = parent.level;
  child.ambientLevel = parent.ambientLevel;
  child.depth = parent.depth + 1;
  child.pathLength = parent.pathLength + parent.length;
  if (parent.kinds & kShadow) child.shadowLength = parent.shadowLength + parent.length;
  child.medium = parent.medium;
  child.scatterers = parent.scatterers;
  child.mist = parent.mist;
  child.clips = (kind & kReflections) ? parent.clips : parent.clipsBeyond;
  child.clipsBeyond = child.clips;
  child.unobstructed = parent.unobstructed;
  child.contribution = parent.contribution;
  if (isMedium(parent.medium.extinction)) child.contribution *= passedBy(parent);
}

// Swaps the front and the back of the surface that was hit.
inline void flip(Ray& ray) {
  ray.cosine = -ray.cosine;
  ray.normal = -ray.normal;
  ray.perturbation = -ray.perturbation;
}

// Turns a hit from behind into a hit from the front.
inline void turnRound(Ray& ray) {
  if (!(ray.cosine < 0)) return;
  flip(ray);
  ray.fromBehind = !ray.fromBehind;
}

// Whether the ray hit the front of the surface as the scene defines it, regardless of later flips.
inline bool hitFront(const Ray& ray) { return (ray.cosine > 0) != (ray.fromBehind != ray.insideOut); }

}  // namespace rsphere
