#pragma once
// A bounding volume hierarchy of relays (relays.h). It finds the relays that a beam of light may reach. The
// time of a search grows with the logarithm of the number of relays.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "scene/shape.h"

namespace rsphere {

class RelayTree {
 public:
  // Bounds of one relay or several: the box of their corners, the box of the centers of their bounding
  // spheres, and the largest radius of these spheres (world units).
  struct Bounds {
    Box3d corners, centers;
    double radius = 0;

    void extendBy(const Bounds& other);
  };

  explicit RelayTree(const std::vector<Bounds>& relays);

  // Sets `found` to the indices of all relays that light may reach, in ascending order; it may contain others
  // too. mayReach(Bounds): whether light may reach anything within the bounds. If it is true for some bounds,
  // it must be true for all bounds that contain them.
  template <class MayReach>
  void find(const MayReach& mayReach, std::vector<uint32_t>& found) const {
    found.clear();
    if (!nodes_.empty()) find(0, mayReach, found);
    std::ranges::sort(found);
  }

 private:
  static constexpr uint32_t kFewest = 4;  // nodes with at most this number of relays are leaves

  struct Node {
    Bounds bounds;
    uint32_t begin = 0, end = 0;  // range in numbers_
    uint32_t second = 0;          // index of the second child; the first child follows the node. 0: a leaf
  };

  uint32_t build(const std::vector<Bounds>& relays, uint32_t begin, uint32_t end);

  template <class MayReach>
  void find(uint32_t at, const MayReach& mayReach, std::vector<uint32_t>& found) const {
    const Node& node = nodes_[at];
    if (!mayReach(node.bounds)) return;
    if (node.second == 0) {
      found.insert(found.end(), numbers_.begin() + node.begin, numbers_.begin() + node.end);
      return;
    }
    find(at + 1, mayReach, found);
    find(node.second, mayReach, found);
  }

  std::vector<Node> nodes_;
  std::vector<uint32_t> numbers_;
};

}  // namespace rsphere
