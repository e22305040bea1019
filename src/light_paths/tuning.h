#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// Light paths (light_vertices.h). Lengths are relative to the mean distance from the sources to the first
// surfaces. Measured in the open-plan office, around a goal or with its lamps (-Sn 512, -ab 3). "Error" is
// the rms error of answers.
struct LightVertices {
  // Distance at which rays towards near surfaces estimate half of the light between diffuse surfaces
  // (NearLight::share()). Joins of a point with light paths hardly increase in number below it
  // (DiffuseGlances). Measured: with .05, the error around the goal is 40% larger; .2 and .3 have no effect
  // beyond noise.
  //
  // Also the distance at which rays leave half of their light to joins with the eye
  // (NearLight::closeShare()), relative to the smaller of the distance from the eye and the mean distance.
  // Without these joins, one answer in 200 around the goal is 10% too bright, because the eye sees a gap of
  // 2 mm between a sheet of paper and the goal. Measured: with .01, the error is 10% larger, in a tenth less
  // time.
  RSPHERE_TUNED(LightVertices, double, kWidth, .15);
  // Light paths that measure the mean distance from the sources to the first surfaces, and directions that
  // estimate the power of a source with a pattern or a cone. If single values vary as much as their mean,
  // such means are known within 3%.
  static constexpr size_t kMeasured = 1024;
  // Cap on the surfaces that a light path hits, for mirrors that face each other, and on the parts that it is
  // split into. Russian roulette ends nearly all paths earlier.
  static constexpr size_t kMostHits = 1024;
  // NearLight::closeShare() is 0 beyond ten times the distance at which share() is 1/2, and so for most
  // vertices.
  static constexpr double kRest = 1. / 101;
};

// The light of vertices at a place (vertex_light.h).
struct VertexLight {
  // kClusters: number of clusters of vertices. kCandidates: number of vertices that are sampled at each
  // place, by estimates of the clusters' light. Both together take as long as a shadow ray. Measured: 256 and
  // 512 clusters have .75 and .5 of the variance of this light in 1.5 and 2.5 times the whole time. A light
  // path from a source with a pattern or a cone also has kCandidates candidates, one of which is followed.
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kClusters, 128);
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kCandidates, 8);
  // One more candidate is sampled from the unbounded vertices next to a place (near_vertices.h), which are
  // found by a grid of cubes. The size of the cubes is chosen so that the cube of an unbounded vertex has
  // this number of them on average, unless they are farther apart than LightVertices::kWidth. Measured on a
  // wall close to a ceiling that mirrors light: relative variance without this candidate 39; with the value
  // 1, 2, 4, 8, 16: 5.1, 3.5, 2.0, 4.1, 8.
  RSPHERE_TUNED(VertexLight, double, kInCube, 4);
  // When vertices are clustered, this is the distance that is assigned to opposite normals, in units of twice
  // the diagonal of the box around all vertices. With .12, the variance of this light is up to three times as
  // large.
  RSPHERE_TUNED(VertexLight, double, kFacing, .05);
  // Number of candidates that get a shadow ray. 8 has no effect beyond noise.
  RSPHERE_TUNED(VertexLight, int, kJoined, 2);
  // Rough surfaces seen in a mirror usually get one shadow ray. If their specularity is at least this, they
  // get the shadow rays of ordinary next-event estimation, because with a single ray their highlights would
  // be too noisy: brushed steel beside a goal of radiance 1 would show up to 14 W/sr/m2.
  RSPHERE_TUNED(VertexLight, double, kStrong, .1);
  // Probability of a gather at a surface that is seen in a reflection. The gather estimates light that has
  // reached the surface by another reflection, which vertices do not provide.
  //
  // At a place that the eye sees directly, a path from the eye estimates the light that light paths do not
  // carry. It is always followed if at least the fraction kFollowed of all hits of light paths are on unknown
  // surfaces. If fewer are, its probability is proportional to their fraction, but at least half of
  // kFollowed.
  RSPHERE_TUNED(VertexLight, double, kFollowed, .25);
};

}  // namespace rsphere::tuning
