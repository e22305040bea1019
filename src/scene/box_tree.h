#pragma once
// A binary tree of boxes.
#include <cstdint>
#include <vector>

#include "base/function_ref.h"
#include "scene/shape.h"

namespace rsphere {

struct BoxTree {
  // A node contains the boxes order[begin] to order[end - 1].
  struct Node {
    Box3d box;
    size_t begin, end;
    size_t second;  // index of the second child; the first child follows the node. 0: a leaf
  };
  std::vector<Box3d> boxes;     // all boxes, including empty ones
  std::vector<uint32_t> order;  // indices of the boxes that are not empty, in spatial order
  std::vector<Node> nodes;      // empty if all boxes are empty

  BoxTree() = default;
  // Fewer than 2^32 boxes.
  explicit BoxTree(std::vector<Box3d> all);

  const Box3d& boxOf(size_t place) const { return boxes[order[place]]; }
  // Calls use() with the index of each box, until use() returns true. Returns whether it has returned true. A
  // box is left out if mayMeet() is false for it, or for a box that contains it and others.
  bool any(FunctionRef<bool(const Box3d&)> mayMeet, FunctionRef<bool(uint32_t)> use) const;
  // The boxes that intersect `box`.
  bool any(const Box3d& box, FunctionRef<bool(uint32_t)> use) const {
    return any([&](const Box3d& other) { return other.intersects(box); }, use);
  }

 private:
  size_t makeNode(size_t begin, size_t end);
};

}  // namespace rsphere
