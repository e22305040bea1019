#include "scene/box_tree.h"

#include <algorithm>
#include <array>

namespace rsphere {

BoxTree::BoxTree(std::vector<Box3d> all) : boxes(std::move(all)) {
  for (uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].isEmpty()) order.push_back(i);
  if (!order.empty()) makeNode(0, order.size());
}

// Makes the subtree for the places from begin to end. Returns its index.
size_t BoxTree::makeNode(size_t begin, size_t end) {
  const size_t index = nodes.size();
  Box3d box;
  for (size_t i = begin; i < end; ++i) box.extendBy(boxOf(i));
  nodes.push_back({box, begin, end, 0});
  if (end - begin <= 1) return index;
  const auto axis = static_cast<int>(box.majorAxis());
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [&](size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
    const double x = boxes[a].center()[axis], y = boxes[b].center()[axis];
    return x != y ? x < y : a < b;
  });
  makeNode(begin, middle);
  const size_t second = makeNode(middle, end);
  nodes[index].second = second;
  return index;
}

bool BoxTree::any(FunctionRef<bool(const Box3d&)> mayMeet, FunctionRef<bool(uint32_t)> use) const {
  if (nodes.empty()) return false;
  std::array<size_t, 64> open;  // a tree of 2^32 boxes has fewer levels
  size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const size_t index = open[--count];
    const Node& node = nodes[index];
    if (!mayMeet(node.box)) continue;
    if (node.second == 0) {
      if (use(order[node.begin])) return true;
    } else {
      open[count++] = node.second;
      open[count++] = index + 1;
    }
  }
  return false;
}

}  // namespace rsphere
