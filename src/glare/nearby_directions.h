#pragma once
// Directions that lie close together on the sphere.
#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace rsphere {

using Imath::V3d;

// Finds those of a number of directions (unit) that are near another. Keeps a reference to them.
class NearbyDirections {
 public:
  // angle: the largest between directions that are near each other, rad; above 0 and below pi.
  NearbyDirections(std::span<const V3d> directions, double angle);

  // Appends those near `direction` to `taken` and removes them from this object.
  void takeNear(const V3d& direction, std::vector<size_t>& taken);

 private:
  struct Cell {
    int64_t x, y, z;
  };
  Cell cellOf(const V3d& direction) const;
  static uint64_t key(const Cell& cell);

  std::span<const V3d> directions_;
  double chord_;
  std::unordered_map<uint64_t, std::vector<size_t>> cells_;
};

// Divides directions into groups: those within `angle` (rad) of each other belong together, and so do those
// that a chain of such steps connects. The number of the group for each direction, from 0 in the order in
// which they occur.
std::vector<size_t> connectedGroups(std::span<const V3d> directions, double angle);

}  // namespace rsphere
