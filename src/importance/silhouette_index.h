#pragma once
// Which of many silhouettes may hold a direction: most hold none, and to ask each took a fifth of a point's
// time.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "importance/silhouette.h"
#include "importance/tuning.h"

namespace rsphere {

// The sphere of directions in cells, those of a cube's faces; each knows the silhouettes whose surrounding
// caps reach into it.
class SilhouetteIndex {
 public:
  // number: what near() calls it by.
  void add(uint32_t number, const Silhouette& silhouette);

  // The numbers, in the order in which they were added, of some silhouettes among which are all that contain
  // the direction (unit).
  std::span<const uint32_t> near(const V3d& direction) const;

 private:
  static constexpr int kSide = tuning::Silhouettes::kSide;
  std::array<std::vector<uint32_t>, 6 * kSide * kSide> cells_;
};

}  // namespace rsphere
