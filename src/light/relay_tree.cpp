#include "light/relay_tree.h"

#include <numeric>

namespace rsphere {

void RelayTree::Bounds::extendBy(const Bounds& other) {
  corners.extendBy(other.corners);
  centers.extendBy(other.centers);
  radius = std::max(radius, other.radius);
}

RelayTree::RelayTree(const std::vector<Bounds>& relays) : numbers_(relays.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0);
  if (!relays.empty()) build(relays, 0, static_cast<uint32_t>(relays.size()));
}

// Appends a node for the relays from begin to end in numbers_, and its descendants. Returns its index.
uint32_t RelayTree::build(const std::vector<Bounds>& relays, uint32_t begin, uint32_t end) {
  const auto at = static_cast<uint32_t>(nodes_.size());
  Node node{{}, begin, end};
  for (uint32_t i = begin; i < end; ++i) node.bounds.extendBy(relays[numbers_[i]]);
  nodes_.push_back(node);
  if (end - begin <= kFewest) return at;
  const unsigned axis = node.bounds.centers.majorAxis();
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      numbers_.begin() + begin, numbers_.begin() + middle, numbers_.begin() + end,
      [&](uint32_t a, uint32_t b) { return relays[a].centers.min[axis] < relays[b].centers.min[axis]; });
  build(relays, begin, middle);
  const uint32_t second = build(relays, middle, end);
  nodes_[at].second = second;
  return at;
}

}  // namespace rsphere
