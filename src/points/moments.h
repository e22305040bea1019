#pragma once
#include <optional>
#include <vector>

#include "points/point_answer.h"
#include "sphere/direction_bins.h"

namespace rsphere {

// Integrals over all directions, from which the quantities of PointAnswer are computed. L is radiance, d a
// unit direction; world axes.
struct Moments {
  Irradiance total;        // of L
  Irradiance cylindrical;  // of L sin(angle to z)
  Irradiance facing[6];    // of L |cos(angle to the axis)| over the hemispheres around +x -x +y -y +z -z
  V3d light{0, 0, 0};      // of photopicOf(L) d, W/m2
  // atEye: integral of L max(0, d . gaze) for the line of sight `gaze` (unit), if there is one.
  std::optional<V3d> gaze;
  Irradiance atEye;
  // ofZones: the integral of L over each zone (-Sz). borders: variance due to cells that cross zone borders.
  const DirectionBins* zones = nullptr;  // null: there are none
  std::vector<Irradiance> ofZones;
  std::vector<Color> borders;

  explicit Moments(const DirectionBins* by = nullptr, const std::optional<V3d>& towards = {})
      : gaze(towards), zones(by), ofZones(by ? by->count() : 0), borders(by ? by->count() : 0) {}

  // Adds one direction. part: its radiance times its solid angle. sampling: RayOptions::sampling. cell: the
  // solid angle (sr) of its cell, which is divided among zones; 0: the direction belongs to one zone. isEven:
  // whether it lies in the middle of its cell, as evenly spread directions do.
  void add(const V3d& direction, const Irradiance& part, const SpectralSampling* sampling, double cell = 0,
           bool isEven = true);
  void add(const Moments& other, double share);

  // The quantities at a point (world), without their standard errors. Definitions: point_answer.h.
  PointAnswer answer(const V3d& point, size_t directions) const;
};

}  // namespace rsphere
