#pragma once
// Finds the silhouettes that may contain a direction. Most do not contain it, and testing all of them took a
// fifth of the time of a point.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "importance/silhouette.h"
#include "importance/tuning.h"

namespace rsphere {

// The sphere of directions, divided into the cells of a cube's faces. Each cell lists the silhouettes whose
// surrounding caps reach into it.
class SilhouetteIndex {
 public:
  // number: identifies the silhouette in the answers of near().
  void add(uint32_t number, const Silhouette& silhouette);

  // The numbers, in the order in which they were added, of all silhouettes that contain the direction (unit),
  // and of some that do not.
  std::span<const uint32_t> near(const V3d& direction) const;

 private:
  static constexpr int kSide = tuning::Silhouettes::kSide;
  std::array<std::vector<uint32_t>, 6 * kSide * kSide> cells_;
};

}  // namespace rsphere
