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

// Finds directions (unit) in a list that are close to a given one. Keeps a reference to the list.
class NearbyDirections {
 public:
  // angle: directions are close if the angle between them is at most this, rad; above 0 and below pi.
  NearbyDirections(std::span<const V3d> directions, double angle);

  // Moves all directions close to `direction` from this object to `taken`.
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

// Divides directions into connected groups: directions within `angle` (rad) of each other share a group.
// Returns the group of each direction; groups are numbered from 0 in the order of their first direction.
std::vector<size_t> connectedGroups(std::span<const V3d> directions, double angle);

}  // namespace rsphere
