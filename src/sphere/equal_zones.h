#pragma once
// A division of the sphere of directions into zones of equal solid angle, in rows around the z axis.
//
// Source: Leopardi 2006, "A partition of the unit sphere into regions of equal area and small diameter".
#include <Imath/ImathVec.h>

#include <array>
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

  // Divides a cell around a direction (unit) among the zones that it lies in: calls f(zone, share) once for
  // each. The shares sum to 1. solidAngle: of the cell, sr, which is taken for a disk; it is represented by
  // points whose second moment is that of the disk. 0: it is a point.
  template <class F>
  void divide(const V3d& direction, double solidAngle, const F& f) const;

 private:
  static constexpr size_t kPoints = 7;  // the middle and a hexagon
  void placePoints(const V3d& direction, double solidAngle, std::array<V3d, kPoints>& points) const;

  std::vector<size_t> first_;  // the number of the first zone in each row; then count()
};

template <class F>
void EqualZones::divide(const V3d& direction, double solidAngle, const F& f) const {
  if (!(solidAngle > 0) || count() == 1) return f(zoneAt(direction), 1.);
  std::array<V3d, kPoints> points;
  placePoints(direction, solidAngle, points);
  std::array<size_t, kPoints> zone;
  bool same = true;
  for (size_t i = 0; i < kPoints; ++i) {
    zone[i] = zoneAt(points[i]);
    same = same && zone[i] == zone[0];
  }
  if (same) return f(zone[0], 1.);
  for (size_t i = 0; i < kPoints; ++i) {
    size_t times = 0, before = 0;
    for (size_t k = 0; k < kPoints; ++k) (k < i ? before : times) += zone[k] == zone[i];
    if (before == 0) f(zone[i], static_cast<double>(times) / kPoints);
  }
}

}  // namespace rsphere
