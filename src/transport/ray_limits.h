#pragma once
// How far paths are followed and into how many rays they split: -lr, -lw, -ss, and the limit for gathers.
#include <algorithm>

#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray.h"
#include "transport/tuning.h"

namespace rsphere {

// Whether a path goes on along a ray, which has just begun at the end of its parent. The path ends beyond -lr
// reflections, and below the weight limit (-lw): always if -lr is positive, otherwise by Russian roulette.
// Roulette also ends paths if their root has too many descendants; the ray is added to them
// (state.descendants). NextRay::coefficient is increased if the path survived roulette, so that the mean
// stays unbiased. Throws rad::Error if roulette has no weight limit to compare with (-lw 0).
bool goesOnAlong(NextRay& next, const PreparedScene& prepared, PathState& state);

// Russian roulette: whether the path of a ray goes on. If so, its weight is at least `least`, and its
// coefficient makes up for the paths that do not go on.
inline bool survives(Random& random, double least, NextRay& next) {
  const double probability = next.context.weight / least;
  if (probability >= 1) return true;
  if (random.uniform() >= probability) return false;
  next.coefficient /= probability;
  next.context.contribution /= probability;
  next.context.weight = least;
  return true;
}

// Whether a patch of the coarse solution is used for the indirect light where a ray hits. Each ray of a
// gather may use some patches; Russian roulette allows further ones in proportion to what they may
// contribute. coefficient: the factor of the mean radiance over the hemisphere in the ray's radiance. It is
// increased if the patch survived roulette.
bool asksForPatch(PathState& state, const PathContext& ray, Coefficient& coefficient);

// Begins to count the descendants of a primary ray, if their number is limited (TracingMode::boundsWork).
// rays: -ad + -as.
inline Descendants descendantsOfPrimary(const TracingMode& mode, int rays) {
  return {mode.boundsWork ? tuning::RayLimits::kMostDescendants * std::max(rays, 1) : 0, 1, 0, 0, 0};
}

// Begins to count the descendants of a ray of PathTracer::glimpse(). level: its ambientLevel.
inline Descendants descendantsOfGlimpse(int level) {
  return {tuning::RayLimits::kMostDescendants, 1, 0, level, 0};
}

// Begins to count the descendants of all rays of a patch of the coarse solution together. depth: of the
// imagined ray at whose end they begin.
inline Descendants descendantsOfPatch(int rays, int depth) {
  return {tuning::RayLimits::kMostOfPatch * rays, kMeanReflectance, depth + 1, 1, 0};
}

// Begins to count the descendants of a gather's ray, if light is interpolated. Two kinds of rays are counted
// with an earlier ray instead: if the descendants of the primary ray are limited, all rays count as its
// descendants; and the rays of a patch count together, except that each has a count of its own of the patches
// that it uses.
inline void countDescendants(const PathSettings& settings, PathState& state, const PathContext& ray) {
  if (state.links)
    state.descendants.patches = 0;
  else if (settings.caches.field && !settings.mode.boundsWork)
    state.descendants = {tuning::RayLimits::kMostDescendants, ray.weight, ray.depth, ray.ambientLevel, 0};
}

// Whether -lr allows reflections at the end of a ray. Rays that Russian roulette ends do not count: those
// that survive make up for their light.
inline bool goesOn(const PreparedScene& prepared, const PathContext& ray) {
  const int limit = prepared.options().reflectionLimit;
  return limit == 0 || (limit < 0 && ray.level + 1 <= -limit);
}

// Whether the ray is one of the many rays of a gather for interpolation, or descends from one. Noise averages
// out over these rays, so that each takes one sample where a primary ray takes several.
inline bool isOfGather(const PathSettings& settings, const PathContext& ray) {
  return settings.caches.field && ray.ambientLevel > 0;
}

// The number of samples that a ray takes of a lobe, at least 1. wanted: the number for a ray of weight 1.
inline int samplesOf(const PathSettings& settings, const PathContext& ray, double wanted) {
  if (isOfGather(settings, ray)) return 1;
  return std::max(1, static_cast<int>(wanted * std::min(ray.weight, 1.) + .5));
}

}  // namespace rsphere
