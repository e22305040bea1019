#pragma once
#include "importance/point_answer.h"

namespace rsphere {

// The integrals over all directions from which the quantities of PointAnswer follow. L is radiance, d a
// unit direction; world axes.
struct Moments {
  Irradiance total;        // of L
  Irradiance cylindrical;  // of L sin(angle to z)
  Irradiance facing[6];    // of L |cos(angle to the axis)| over the hemispheres around +x -x +y -y +z -z
  V3d light{0, 0, 0};      // of photopicOf(L) d, W/m2

  // Adds one direction. part: its radiance times its solid angle. sampling: RayOptions::sampling.
  void add(const V3d& direction, const Irradiance& part, const SpectralSampling* sampling);
  void add(const Moments& other, double share);

  // The quantities at a point (world), without their standard errors. Definitions: point_answer.h.
  PointAnswer answer(const V3d& point, size_t directions) const;
};

}  // namespace rsphere
