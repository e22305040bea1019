#pragma once
// Finds unbounded light vertices around a place: vertices whose light grows without bound as the place comes
// near them (LightVertex::isUnbounded()). Clusters of vertices are up to meters wide. Sampled by its cluster
// alone, an unbounded vertex a few centimeters from the place would be chosen rarely, and then represent
// thousands of times its light.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/random.h"
#include "scene/shape.h"

namespace rsphere {

struct LightVertex;

// A grid of cubes. Constant.
class NearVertices {
 public:
  // Empty if none of the vertices is unbounded. width: half the side of the largest cubes, world units, above
  // 0. around() contains all unbounded vertices within half the side of the cubes.
  static std::optional<NearVertices> of(std::span<const LightVertex> vertices, double width);

  // The unbounded vertices in the eight cubes next to a place.
  class Around {
   public:
    bool empty() const { return !(power_ > 0); }
    // The index of a vertex, with probabilities proportional to power. REQUIRES that there are some.
    uint32_t draw(Random& random) const;
    // The probability with which draw() returns it; 0 for all vertices that are not in the cubes.
    double probabilityOf(const LightVertex& vertex) const;

   private:
    friend class NearVertices;
    struct Part {
      uint32_t begin = 0, end = 0;  // in NearVertices::vertices_
    };
    explicit Around(const NearVertices& all) : all_(all) {}

    const NearVertices& all_;
    std::array<int64_t, 3> low_{};  // the first cube
    std::array<Part, 8> parts_{};
    double power_ = 0;
  };
  Around around(const V3d& point) const;

 private:
  NearVertices() = default;
  using ByCube = std::vector<std::pair<uint64_t, uint32_t>>;  // keyOf(), index of a vertex; sorted
  ByCube sorted(std::span<const LightVertex> vertices) const;
  std::array<int64_t, 3> cubeAt(const V3d& point, double offset) const;
  static uint64_t keyOf(const std::array<int64_t, 3>& cube);
  size_t slotOf(uint64_t key) const;
  double powerOf(const Around::Part& part) const { return sums_[part.end] - sums_[part.begin]; }

  V3d origin_{0, 0, 0};
  double side_ = 1;
  std::vector<uint32_t> vertices_;  // indices of the unbounded ones, by cube
  std::vector<double> sums_;        // cumulative power before each of vertices_, then the total
  struct Slot {
    uint64_t key = 0;
    Around::Part part;
  };
  std::vector<Slot> slots_;  // a hash table with open addressing; its size is a power of two
};

}  // namespace rsphere
