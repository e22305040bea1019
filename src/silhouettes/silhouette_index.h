#pragma once
// Finds the silhouettes that may contain a direction. Testing all silhouettes took a fifth of the time of a
// point.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouettes/silhouette.h"
#include "silhouettes/tuning.h"

namespace rsphere {

// Divides the sphere of directions into cells on the faces of a cube. Each cell lists the silhouettes whose
// surrounding caps overlap it.
class SilhouetteIndex {
 public:
  // number: the name of the silhouette in the result of near().
  void add(uint32_t number, const Silhouette& silhouette);

  // The numbers of all silhouettes that contain the direction (unit), and of some that do not, in the order
  // in which they were added.
  std::span<const uint32_t> near(const V3d& direction) const;

 private:
  static constexpr int kSide = tuning::Silhouettes::kSide;
  std::array<std::vector<uint32_t>, 6 * kSide * kSide> cells_;
};

}  // namespace rsphere
