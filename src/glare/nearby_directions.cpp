#include "glare/nearby_directions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rsphere {

NearbyDirections::NearbyDirections(std::span<const V3d> directions, double angle)
    : directions_(directions), chord_(2 * std::sin(angle / 2)) {
  for (size_t i = 0; i < directions.size(); ++i) cells_[key(cellOf(directions[i]))].push_back(i);
}

NearbyDirections::Cell NearbyDirections::cellOf(const V3d& direction) const {
  const auto at = [this](double x) { return static_cast<int64_t>(std::floor(x / chord_)); };
  return {at(direction.x), at(direction.y), at(direction.z)};
}

// Cells are numbered from the corner (-2, -2, -2), with 21 bits for each axis.
uint64_t NearbyDirections::key(const Cell& cell) {
  constexpr int64_t kMiddle = int64_t{1} << 20;
  const auto part = [](int64_t n) {
    return static_cast<uint64_t>(std::clamp(n, -kMiddle, kMiddle - 1) + kMiddle);
  };
  return part(cell.x) << 42 | part(cell.y) << 21 | part(cell.z);
}

void NearbyDirections::takeNear(const V3d& direction, std::vector<size_t>& taken) {
  const auto [x, y, z] = cellOf(direction);
  for (int64_t i = x - 1; i <= x + 1; ++i)
    for (int64_t j = y - 1; j <= y + 1; ++j)
      for (int64_t k = z - 1; k <= z + 1; ++k) {
        const auto found = cells_.find(key({i, j, k}));
        if (found == cells_.end()) continue;
        std::erase_if(found->second, [&](size_t index) {
          if ((directions_[index] - direction).length2() > chord_ * chord_) return false;
          taken.push_back(index);
          return true;
        });
      }
}

std::vector<size_t> connectedGroups(std::span<const V3d> directions, double angle) {
  constexpr size_t kUnknown = std::numeric_limits<size_t>::max();
  NearbyDirections left(directions, angle);
  std::vector<size_t> groups(directions.size(), kUnknown), members;
  size_t count = 0;
  for (size_t i = 0; i < directions.size(); ++i) {
    if (groups[i] != kUnknown) continue;
    members.clear();
    left.takeNear(directions[i], members);
    for (size_t k = 0; k < members.size(); ++k) {
      const V3d direction = directions[members[k]];
      groups[members[k]] = count;
      left.takeNear(direction, members);
    }
    ++count;
  }
  return groups;
}

}  // namespace rsphere
