#pragma once
// Finds the objects that matter at a point, in a time that does not depend on the number of all objects. Each
// object matters within a limited distance, its reach.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/shape.h"

namespace rsphere {

class ReachGrid {
 public:
  // The region within a distance of a line segment (world units).
  struct Reach {
    V3d begin{0, 0, 0}, end{0, 0, 0};
    double distance = 0;
  };

  // bounds: of the points for which at() will be called; not empty.
  ReachGrid(const std::vector<Reach>& reaches, const Box3d& bounds);
  ReachGrid() = default;  // without objects

  // The indices of all objects whose reach contains the point, in ascending order; may include some nearby
  // ones.
  std::span<const uint32_t> at(const V3d& point) const {
    if (begin_.empty()) return {};
    const V3d cell = (point - low_) * perLength_;
    const size_t i = (inner(cell.z, counts_[2]) * counts_[1] + inner(cell.y, counts_[1])) * counts_[0] +
                     inner(cell.x, counts_[0]);
    return {numbers_.data() + begin_[i], numbers_.data() + begin_[i + 1]};
  }

 private:
  // The index of a cell, from 0 to count - 1. Places outside of the grid use its first or last cell.
  static size_t inner(double at, size_t count) {
    return at > 0 ? (at < static_cast<double>(count) ? static_cast<size_t>(at) : count - 1) : 0;
  }

  V3d low_{0, 0, 0};
  double perLength_ = 0;  // cells per world unit
  std::array<size_t, 3> counts_{};
  std::vector<uint32_t> begin_, numbers_;  // begin_: index in numbers_ of the first number of each cell
};

}  // namespace rsphere
