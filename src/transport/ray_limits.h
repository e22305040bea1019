#pragma once
// Limits how far paths are followed and how often they split: -lr, -lw, -ss, and the limits for gathers.
#include <algorithm>

#include "rays/prepared_scene.h"
#include "rays/ray.h"
#include "transport/path_state.h"
#include "transport/tuning.h"

namespace rsphere {

// Whether a path continues along a new ray at the end of its parent. Paths end after -lr reflections. Below
// the weight limit (-lw), they end always if -lr is positive, and by Russian roulette otherwise. Roulette
// also ends paths whose root has too many descendants; a ray that continues is added to state.descendants.
// After surviving roulette, NextRay::coefficient is increased, so that the result stays unbiased. Throws
// rad::Error if roulette has no weight limit to compare with (-lw 0).
bool goesOnAlong(NextRay& next, const PreparedScene& prepared, PathState& state);

// Russian roulette: whether the path continues along a ray. If so, the ray's weight becomes at least `least`,
// and its coefficient is increased to compensate for the paths that end.
inline bool survives(Random& random, double least, NextRay& next) {
  const double probability = next.context.weight / least;
  if (probability >= 1) return true;
  if (random.uniform() >= probability) return false;
  next.coefficient /= probability;
  next.context.contribution /= probability;
  next.context.weight = least;
  return true;
}

// Whether the indirect light at the hit of a ray is taken from a patch of the coarse solution. Each ray of a
// gather may use some patches. For further patches, Russian roulette decides with a probability proportional
// to their largest possible contribution. coefficient: factor on the mean radiance over the hemisphere in the
// ray's radiance; increased after surviving roulette.
bool asksForPatch(PathState& state, const PathContext& ray, Coefficient& coefficient);

// Starts counting the descendants of a primary ray, if their number is limited (TracingMode::boundsWork).
// rays: -ad plus -as.
inline Descendants descendantsOfPrimary(const TracingMode& mode, int rays) {
  return {mode.boundsWork ? tuning::RayLimits::kMostDescendants * std::max(rays, 1) : 0, 1, 0, 0, 0};
}

// Starts counting the descendants of a ray of PathTracer::glimpse(). level: its ambientLevel.
inline Descendants descendantsOfGlimpse(int level) {
  return {tuning::RayLimits::kMostDescendants, 1, 0, level, 0};
}

// Starts counting the descendants of all rays of a patch of the coarse solution together. depth: of the
// fictitious ray at whose end they start.
inline Descendants descendantsOfPatch(int rays, int depth) {
  return {double{tuning::RayLimits::kFreely} * rays, kMeanReflectance, depth + 1, 1, 0};
}

// Starts a new count of descendants for one ray of a final gather, if light is interpolated. There are two
// exceptions:
// - If the descendants of the primary ray are limited, the count for the primary ray continues.
// - If the gather is for a patch of the coarse solution, the count for all rays of this gather continues.
//   Only the number of other patches that are used (Descendants::patches) starts again with each ray.
inline void countDescendants(const PathSettings& settings, PathState& state, const PathContext& ray) {
  if (state.links)
    state.descendants.patches = 0;
  else if (settings.caches.field && !settings.mode.boundsWork)
    state.descendants = {tuning::RayLimits::kMostDescendants, ray.weight, ray.depth, ray.ambientLevel, 0};
}

// Whether -lr allows further reflections at the end of a ray. Russian roulette is ignored, because surviving
// rays compensate for the others.
inline bool goesOn(const PreparedScene& prepared, const PathContext& ray) {
  const int limit = prepared.options().reflectionLimit;
  return limit == 0 || (limit < 0 && ray.level + 1 <= -limit);
}

// Whether the ray belongs to a gather for interpolation, or descends from one of its rays. Noise averages out
// over these many rays, so that each takes one sample where a primary ray takes several.
inline bool isOfGather(const PathSettings& settings, const PathContext& ray) {
  return settings.caches.field && ray.ambientLevel > 0;
}

// The number of samples that a ray takes of a lobe, at least 1. wanted: the number for a ray of weight 1.
inline int samplesOf(const PathSettings& settings, const PathContext& ray, double wanted) {
  if (isOfGather(settings, ray)) return 1;
  return std::max(1, static_cast<int>(wanted * std::min(ray.weight, 1.) + .5));
}

}  // namespace rsphere
