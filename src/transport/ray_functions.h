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

// Makes a hit from behind one from the front.
inline void turnRound(Ray& ray) {
  if (ray.cosine >= 0) return;
  ray.cosine = -ray.cosine;
  ray.normal = -ray.normal;
  ray.perturbation = -ray.perturbation;
  ray.fromBehind = !ray.fromBehind;
}

// The share of light that a medium lets through. extinction: per unit length.
inline Rgb passing(const Rgb& extinction, double length) {
  if (isBlack(extinction)) return Rgb(1, 1, 1);
  return Rgb(std::exp(-extinction.x * length), std::exp(-extinction.y * length),
             std::exp(-extinction.z * length));
}

}  // namespace rsphere
