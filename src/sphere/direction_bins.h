#pragma once
// A division of the sphere of directions into bins: zones of equal solid angle, or the bins of a function.
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "sphere/equal_zones.h"

namespace rsphere {

class DirectionBins {
 public:
  // Equal zones. REQUIRES count >= 1.
  explicit DirectionBins(size_t count)
      : zones_(count), count_(count), solidAngles_(count, zones_.solidAngle()) {}
  // The bins 0 to count - 1, as numbered by a function of the direction (unit); directions with any other
  // number are in no bin. Bins consist of a million equal zones, each assigned by its middle. A border may
  // therefore be off by half the width of a zone, .1 degrees.
  DirectionBins(size_t count, const std::function<size_t(const V3d&)>& binOf);

  size_t count() const { return count_; }
  // sr; 0 if the bin contains no direction.
  double solidAngle(size_t bin) const { return solidAngles_[bin]; }

  // The bin of a direction (unit); count(): none.
  size_t binAt(const V3d& direction) const {
    const size_t zone = zones_.zoneAt(direction);
    return binOf_.empty() ? zone : binOf_[zone];
  }

  // Divides a cell around a direction (unit) among bins: calls f(bin, share) once for each. The shares sum to
  // 1, except for the part in no bin. solidAngle: of the cell, sr; 0: it is a point. The cell is assumed to
  // be a disk, and represented by points with the second moment of the disk.
  template <class F>
  void divide(const V3d& direction, double solidAngle, const F& f) const;

 private:
  static constexpr size_t kPoints = 7;  // the middle and a hexagon
  static void placePoints(const V3d& direction, double solidAngle, std::array<V3d, kPoints>& points);

  EqualZones zones_;
  std::vector<uint32_t> binOf_;  // by zone; empty: the zones are the bins
  size_t count_;
  std::vector<double> solidAngles_;
};

template <class F>
void DirectionBins::divide(const V3d& direction, double solidAngle, const F& f) const {
  const auto give = [&](size_t bin, double share) {
    if (bin < count_) f(bin, share);
  };
  if (!(solidAngle > 0) || (count_ == 1 && binOf_.empty())) return give(binAt(direction), 1.);
  std::array<V3d, kPoints> points;
  placePoints(direction, solidAngle, points);
  std::array<size_t, kPoints> bin;
  bool same = true;
  for (size_t i = 0; i < kPoints; ++i) {
    bin[i] = binAt(points[i]);
    same = same && bin[i] == bin[0];
  }
  if (same) return give(bin[0], 1.);
  for (size_t i = 0; i < kPoints; ++i) {
    size_t times = 0, before = 0;
    for (size_t k = 0; k < kPoints; ++k) (k < i ? before : times) += bin[k] == bin[i];
    if (before == 0) give(bin[i], static_cast<double>(times) / kPoints);
  }
}

}  // namespace rsphere
