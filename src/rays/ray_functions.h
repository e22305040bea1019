#pragma once
// Constants and small functions for rays that the parts of PathTracer share.

#include <cmath>
#include <utility>

#include "base/constants.h"
#include "rays/ray.h"
#include "scene/material.h"

namespace rsphere {

// The mean reflectance of surfaces: a usual value for rooms, which RADIANCE uses, too. With interpolated
// light, it is the weight of each indirect ray relative to its parent, instead of the small weight of one
// among many directions. The weight limit then ends paths after some bounces, independently of the number of
// directions.
inline constexpr double kMeanReflectance = .5;

// A diffuse material of reflectance pi. Its radiance, pi times the mean incident radiance, is equal to the
// irradiance (-i, -I).
inline const Opaque kIrradianceMeter{Color(kPi, kPi, kPi), 0, 0, false};

// The apparent distance of the object seen along a ray: of the mirrored object if this contributes more than
// half of the radiance.
inline double apparentLength(const RayResult& seen) {
  return brightness(seen.mirrored) > .5 * brightness(seen.value) ? seen.mirroredLength
                                                                 : seen.unmirroredLength;
}

// Whether the extinction has any effect within a distance of kFarAway.
inline bool isMedium(const Color& extinction) { return maxChannel(extinction) > 1 / kFarAway; }

// The transmittance of a medium. extinction: per unit length.
inline Coefficient transmittanceOf(const Color& extinction, double length) {
  Color transmittance = extinction;
  transmittance.transform([&](double k) { return std::exp(-k * length); });
  return Coefficient(std::move(transmittance));
}
inline Coefficient passing(const Color& extinction, double length) {
  return isMedium(extinction) ? transmittanceOf(extinction, length) : Coefficient(1);
}

// The transmittance of the medium along a ray. Shadow rays are only attenuated by absorption: in-scattering
// is assumed to compensate for the light scattered out of them.
inline Coefficient passedBy(const RayEnd& end) {
  const Medium& medium = end.medium();
  if (!isMedium(medium.extinction)) return Coefficient(1);
  const bool scatteredIn = (end.context.kinds & kShadow) != 0;
  return passing(scatteredIn ? medium.extinction * (Color(1, 1, 1) - medium.albedo) : medium.extinction,
                 end.hit.length);
}

inline NextRay::NextRay(const RayEnd& parent, RayKind kind, const Coefficient& ofParent)
    : query{.origin = parent.hit.point, .from = parent.hit.surface, .unobstructed = parent.ray.unobstructed},
      context{.kind = kind,
              .kinds = parent.context.kinds | kind,
              .level = parent.context.level,
              .depth = parent.context.depth + 1,
              .ambientLevel = parent.context.ambientLevel,
              .pathLength = parent.context.pathLength + parent.hit.length,
              .shadowLength =
                  parent.context.kinds & kShadow ? parent.context.shadowLength + parent.hit.length : 0,
              .known = parent.known,
              .parent = &parent,
              .space = parent.space(),
              .clips = (kind & kReflections) ? parent.context.clips : parent.clipsBeyond,
              .contribution = parent.context.contribution},
      coefficient(ofParent) {
  if (isMedium(parent.medium().extinction)) context.contribution *= passedBy(parent);
}

// A ray that continues another one without a change of direction or weight.
inline NextRay straightOn(const RayEnd& end) {
  NextRay next(end, kTransmitted, Coefficient(1));
  next.query.direction = end.ray.direction;
  next.query.aimedAt = end.ray.aimedAt;
  next.context.mirror = end.context.mirror;
  next.context.weight = end.context.weight;
  return next;
}

// Swaps the front and the back of the surface that was hit.
inline void flip(SurfaceHit& hit) {
  hit.cosine = -hit.cosine;
  hit.normal = -hit.normal;
  hit.perturbation = -hit.perturbation;
}

// If the surface was hit from behind, flips the hit so that its front faces the ray.
inline void turnRound(SurfaceHit& hit) {
  if (!(hit.cosine < 0)) return;
  flip(hit);
  hit.fromBehind = !hit.fromBehind;
}

// Whether the ray hit the front of the surface as the scene defines it, regardless of flips.
inline bool hitFront(const SurfaceHit& hit) { return (hit.cosine > 0) != (hit.fromBehind != hit.insideOut); }

}  // namespace rsphere
