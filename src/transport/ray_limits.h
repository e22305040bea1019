#pragma once
// How far paths are followed and into how many rays they split: -lr, -lw, -ss.
#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

// The weight of an indirect ray in its parent's where light is interpolated: it stands for a mean reflectance
// rather than for its own small share of the light, so that limits of weight end bounces and not directions.
// RADIANCE's own figure.
inline constexpr double kMeanReflectance = .5;

// Makes child a descendant of parent, or returns false where the path ends: below the weight limit (-lw) by
// Russian roulette where -lr is not positive, and beyond -lr reflections. coefficient: of the child's
// radiance in the parent's; raised where the path survived roulette, so that the mean is unbiased. Throws
// rad::Error where roulette has no weight to go by (-lw 0).
bool continueRay(const Transport& transport, Random& random, Ray& child, RayKind kind, const Ray& parent,
                 Rgb& coefficient);

// Whether the ray is one of the many rays of a gather for interpolation, or comes from one. Its own noise
// averages out over them, so that it takes one sample where a primary ray takes several.
inline bool isOfGather(const Transport& transport, const Ray& ray) {
  return transport.field() && ray.ambientLevel > 0;
}

// The number of samples that a ray takes of a lobe of which a ray of weight 1 takes `wanted`; at least 1.
inline int samplesOf(const Transport& transport, const Ray& ray, double wanted) {
  if (isOfGather(transport, ray)) return 1;
  return std::max(1, static_cast<int>(wanted * ray.weight + .5));
}

}  // namespace rsphere
