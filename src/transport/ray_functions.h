#pragma once
// What the parts of PathTracer share, inside this folder.
#include <cmath>
#include <numbers>

#include "scene/material.h"
#include "transport/ray.h"

namespace rsphere {

inline constexpr double kPi = std::numbers::pi;

// Shares of light below it are not followed; RADIANCE's own figure.
inline constexpr double kNegligible = 1e-6;

// A white diffuse surface whose radiance is pi times the mean of what it receives: the irradiance (-i, -I).
inline const Opaque kIrradianceMeter{Rgb(kPi, kPi, kPi), 0, 0, false};

inline bool isBlack(const Rgb& c) { return !(maxChannel(c) > 0); }

// How far what is seen along the ray seems to be: the mirrored image where it is most of the light.
inline double apparentLength(const Ray& ray) {
  return brightness(ray.mirrored) > .5 * brightness(ray.value) ? ray.mirroredLength : ray.unmirroredLength;
}

// Whether there is a medium at all: one that matters within kFarAway.
inline bool isMedium(const Rgb& extinction) { return maxChannel(extinction) > 1 / kFarAway; }

// The share of light that a medium lets through. extinction: per unit length.
inline Rgb passing(const Rgb& extinction, double length) {
  if (!isMedium(extinction)) return Rgb(1, 1, 1);
  return Rgb(std::exp(-extinction.x * length), std::exp(-extinction.y * length),
             std::exp(-extinction.z * length));
}

// The share of a ray's radiance that the medium along it lets through. Shadow rays lose what is absorbed
// alone: what is scattered out of them is taken to be scattered in again.
inline Rgb passedBy(const Ray& ray) {
  const Medium& medium = ray.medium;
  if (!isMedium(medium.extinction)) return Rgb(1, 1, 1);
  const bool scatteredIn = (ray.kinds & kShadow) != 0;
  return passing(scatteredIn ? medium.extinction * (Rgb(1, 1, 1) - medium.albedo) : medium.extinction,
                 ray.length);
}

// What a ray has from the one that it goes on from, whatever made it.
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
  child.contribution = parent.contribution * passedBy(parent);
}

// Swaps the front and the back of the surface that was hit.
inline void flip(Ray& ray) {
  ray.cosine = -ray.cosine;
  ray.normal = -ray.normal;
  ray.perturbation = -ray.perturbation;
}

// Makes a hit from behind one from the front.
inline void turnRound(Ray& ray) {
  if (!(ray.cosine < 0)) return;
  flip(ray);
  ray.fromBehind = !ray.fromBehind;
}

// Whether the ray hit the front of the surface as the scene has it, however it was turned since.
inline bool hitFront(const Ray& ray) { return (ray.cosine > 0) != (ray.fromBehind != ray.insideOut); }

}  // namespace rsphere
