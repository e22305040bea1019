#pragma once
#include <algorithm>
#include <cstdint>

namespace rsphere {

// How the directions of a point are weighted.
enum class Weights : uint8_t { homogeneous /* h */, voronoi /* v */, silhouettes /* c */ };

// The options of the estimator of sphere mode.
struct SphereOptions {
  int baseDirections = 2048;               // -Sn  1 to 1,000,000
  int mostDirections = 4096;               // -Sx  of one set
  int mostForAccuracy = 0;                 // of all sets that -Sa averages, where this is more than -Sx
  double densityFactor = 1;                // -Sk
  double accuracy = 0;                     // -Sa  0: off
  Weights weights = Weights::silhouettes;  // -Sw
  bool basicRadiance = false;              // -Sb
  bool everyDirection = false;             // -Sd
  uint64_t rotation = 0;                   // -Sr
  bool verify = false;                     // -Sv

  // Largest number of directions of one point, over all sets that -Sa averages.
  int mostOfAllSets() const { return std::max(mostDirections, mostForAccuracy); }
};

}  // namespace rsphere
