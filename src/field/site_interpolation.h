#pragma once
// Interpolates light between the sites of four neighbouring cells.
#include <array>

#include "field/hemisphere.h"

namespace rsphere {

// Adds the mean and the moments of a light, multiplied by `share`.
void blend(GatheredLight& into, const GatheredLight& light, float share);

// The sites around a place that see it, with their light and bilinear weights.
struct SitesAround {
  int count = 0;
  std::array<const GatherSite*, 4> site;
  std::array<const GatheredLight*, 4> light;
  std::array<double, 4> weight;
  double served = 0;  // sum of the weights; 1 if all four sites see the place

  // The interpolation error expected between the sites, relative to the tolerance (a relative error). Below 1
  // the light is smooth enough. It is the largest of three measures: the change of the gradients (exact for a
  // parabola), the part of the differences that the gradients do not explain (shadow edges), and the
  // differences themselves.
  double roughness(double tolerance) const;

  // The light at a place (world coordinates): interpolated, and extrapolated by the mean gradient if the
  // sites that see the place do not surround it. extrapolationError: the expected relative error of the
  // extrapolation.
  GatheredLight at(const V3d& place, double& extrapolationError) const;
};

}  // namespace rsphere
