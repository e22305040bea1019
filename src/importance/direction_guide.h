#pragma once
// Where around a point the light comes from, roughly: a density of directions that follows the radiance of
// the surfaces that the point sees (transport/light_patches.h). Directions that are distributed by it,
// besides even ones, reduce the variance where a small part of the view brings most of the light.
//
// Source: Jensen, "Importance driven path tracing using the photon map" (EGWR 1995), with shadow rays to the
// particles.
#include <vector>

#include "scene/random.h"
#include "transport/light_patches.h"

namespace rsphere {

class DirectionGuide {
 public:
  // Around a point (world). tracer: finds what is in the way.
  DirectionGuide(const LightPatches& patches, const Tracer& tracer, const V3d& point);

  // Per sr, of directions that are distributed by it; integrates to 1. 0 everywhere if no light is known of.
  double density(const V3d& direction) const;

  // `count` directions (unit), evenly distributed by the density; successive ones are near to each other.
  std::vector<V3d> directions(size_t count, Random& random) const;

 private:
  static size_t cellOf(const V3d& direction);

  std::vector<double> share_;  // of the directions, by cell; empty: no light
};

}  // namespace rsphere
