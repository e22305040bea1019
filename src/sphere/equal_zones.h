#pragma once
// A division of the sphere of directions into zones of equal solid angle, in rows around the z axis.
//
// Source: Leopardi 2006, "A partition of the unit sphere into regions of equal area and small diameter".
#include <Imath/ImathVec.h>

#include <cstddef>
#include <vector>

namespace rsphere {

using Imath::V3d;

// Row 0 is the cap around +z, the last row that around -z; in between, the zones of a row are as wide as
// high, as far as whole numbers allow. Zones are numbered row by row. Those of a row begin at the azimuth of
// +x and follow each other towards +y.
class EqualZones {
 public:
  // REQUIRES count >= 1. A single zone is the whole sphere.
  explicit EqualZones(size_t count);

  size_t count() const { return first_.back(); }
  // sr, of each zone, exactly.
  double solidAngle() const;
  // The zones in each row, from +z to -z.
  std::vector<size_t> rows() const;

  // The zone that a direction (unit) lies in.
  size_t zoneAt(const V3d& direction) const;
  // A direction (unit) in the middle of a zone; that of a cap is its pole.
  V3d middle(size_t zone) const;

 private:
  std::vector<size_t> first_;  // the number of the first zone in each row; then count()
};

}  // namespace rsphere
