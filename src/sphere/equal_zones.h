#pragma once
// A division of the sphere of directions into zones of equal solid angle, in rows around the z axis.
//
// Source: Leopardi 2006, "A partition of the unit sphere into regions of equal area and small diameter".
#include <Imath/ImathVec.h>

#include <cstddef>
#include <vector>

namespace rsphere {

using Imath::V3d;

// Row 0 is the cap around +z, the last row the cap around -z. In the other rows, zones are as wide as high,
// as nearly as whole numbers allow. Zones are numbered row by row, within a row from the azimuth of +x
// towards +y.
class EqualZones {
 public:
  // REQUIRES count >= 1. A single zone is the whole sphere.
  explicit EqualZones(size_t count);

  size_t count() const { return first_.back(); }
  // The solid angle of each zone, sr; exact.
  double solidAngle() const;
  // The number of zones in each row, from +z to -z.
  std::vector<size_t> rows() const;

  // The zone that contains a direction (unit).
  size_t zoneAt(const V3d& direction) const;
  // The direction (unit) of the middle of a zone; for a cap, the pole.
  V3d middle(size_t zone) const;

 private:
  std::vector<size_t> first_;  // the number of the first zone in each row; then count()
};

}  // namespace rsphere
