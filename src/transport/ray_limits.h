#pragma once
// How far paths are followed and into how many rays they split: -lr, -lw, -ss, and the limit for gathers.
#include "transport/path_state.h"
#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

// The weight of an indirect ray relative to its parent where light is interpolated. It represents a mean
// reflectance instead of the small share of a single direction, so that the weight limit ends paths after
// some bounces and does not depend on the number of directions. The same value as in RADIANCE.
inline constexpr double kMeanReflectance = .5;

// Makes child a descendant of parent, or returns false if the path ends. It ends beyond -lr reflections, and
// below the weight limit (-lw): always if -lr is positive, otherwise by Russian roulette. Roulette also ends
// paths of a gather's ray that has too many descendants (state.descendants, which the child is added to).
// coefficient: of the child's radiance in the parent's. It is increased if the path survived roulette, so that
// the mean stays unbiased. Throws rad::Error if roulette has no weight limit to compare with (-lw 0).
bool continueRay(const Transport& transport, PathState& state, Ray& child, RayKind kind, const Ray& parent,
                 Coefficient& coefficient);

// Russian roulette: whether the path of a child goes on. If so, its weight is at least `least`, and its
// coefficient makes up for the paths that do not go on.
inline bool survives(Random& random, double least, Ray& child, Coefficient& coefficient) {
  const double probability = child.weight / least;
  if (probability >= 1) return true;
  if (random.uniform() >= probability) return false;
  coefficient /= probability;
  child.contribution /= probability;
  child.weight = least;
  return true;
}

// Begins to count the descendants of a gather's ray, if light is interpolated.
inline void countDescendants(const Transport& transport, PathState& state, const Ray& ray) {
  if (transport.field() || transport.coarse()) state.descendants = {ray.weight, ray.depth, 0};
}

// Whether rays reflected at the ray's hit are followed, except those that Russian roulette ends, whose light
// the others make up for. Otherwise -lr ends them for certain.
inline bool goesOn(const Transport& transport, const Ray& ray) {
  const int limit = transport.options().reflectionLimit;
  return limit == 0 || (limit < 0 && ray.level + 1 <= -limit);
}

// Whether the ray is one of the many rays of a gather for interpolation, or descends from one. Noise averages
// out over these rays, so that each takes one sample where a primary ray takes several.
inline bool isOfGather(const Transport& transport, const Ray& ray) {
  return transport.field() && ray.ambientLevel > 0;
}

// The number of samples that a ray takes of a lobe, at least 1. wanted: the number for a ray of weight 1.
inline int samplesOf(const Transport& transport, const Ray& ray, double wanted) {
  if (isOfGather(transport, ray)) return 1;
  return std::max(1, static_cast<int>(wanted * std::min(ray.weight, 1.) + .5));
}

}  // namespace rsphere
