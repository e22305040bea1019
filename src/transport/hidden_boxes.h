#pragma once
// Finds boxes that are certainly hidden from a place, such as the luminaires of all other storeys of a
// building.
//
// A box is hidden from another if a single opaque convex polygon (a slab, a wall) cuts every segment between
// the two. It suffices to look at the segments between their corners: the points where these meet the
// polygon's plane have a convex hull that contains the points where all segments meet it ("shaft culling",
// Haines and Wallace 1991). A light source in such a box need not be sampled: every shadow ray would be
// blocked.
//
// The scene is divided into regions along the planes of such polygons (cells: Teller and Sequin 1991). A
// region is divided when a point in it is first looked up, and only if that saves time. The result depends on
// the scene and the boxes alone.
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "trace/tracer.h"
#include "transport/function_ref.h"

namespace rsphere {

class HiddenBoxes {
 public:
  // Keeps references to the scene and the tracer. An empty box is never hidden. boxes: fewer than 2^32. few:
  // with at most this number of boxes, all count as visible, because finding the hidden ones would take more
  // time than it saves.
  HiddenBoxes(const Scene& scene, const Tracer& tracer, std::vector<Box3d> boxes, size_t few);
  ~HiddenBoxes();
  HiddenBoxes(HiddenBoxes&&) noexcept;

  // In ascending order, the positions of the boxes that are not certainly hidden from the point. Any threads
  // may call it.
  std::span<const uint32_t> notHiddenFrom(const V3d& point) const { return root_ ? find(point) : all_; }
  std::span<const uint32_t> all() const { return all_; }

  // The same for a point of a surface that faces `front` (unit), as far as boxes in front of the surface are
  // concerned: a box that lies entirely behind it may be left out or not. On slabs and walls, more boxes are
  // then found to be hidden.
  std::span<const uint32_t> notHiddenFrom(const V3d& point, const V3d& front) const {
    return root_ ? find(beside(point, front)) : all_;
  }

  // The same for the largest region around the point in which it satisfies `enough`; if none does, for the
  // smallest.
  std::span<const uint32_t> widestWhere(const V3d& point,
                                        FunctionRef<bool(std::span<const uint32_t>)> enough) const;

  // Whether there are regions that some boxes may be hidden from.
  bool divides() const;

  // Whether a polygon hides everything in box `to` from everything in box `from`.
  bool hides(const Box3d& from, const Box3d& to) const;

 private:
  // An opaque polygon, and its edges' normals in its plane, which point inward.
  struct Blocker;
  struct Region;

  V3d beside(const V3d& point, const V3d& front) const;
  std::span<const uint32_t> find(const V3d& point) const;
  const Region& half(const Region& region, int upper) const;
  void divide(Region& region) const;
  bool anyBlocker(const V3d& from, const V3d& to, FunctionRef<bool(const Blocker&)> use) const;
  std::vector<std::pair<Blocker, size_t>> blockersIn(const Region& region) const;
  bool findBlocker(SurfaceId surface, const V3d& from, Blocker& blocker) const;
  bool covers(const Blocker& blocker, const Box3d& from, const Box3d& to) const;
  bool hides(const Box3d& from, const Box3d& to, std::vector<Blocker>& known) const;
  std::vector<uint32_t> visibleFrom(const Box3d& region, std::span<const uint32_t> places,
                                    std::vector<Blocker>& known) const;

  // A binary tree of the boxes that may be hidden: a node has the places from begin to end of `order`.
  struct Tree {
    struct Node {
      Box3d box;
      size_t begin, end;
      size_t second;  // the second child; the first one follows the node. 0: a leaf
    };
    std::vector<Box3d> boxes;     // by position, with the empty ones
    std::vector<uint32_t> order;  // positions, so that near ones lie side by side
    std::vector<Node> nodes;

    const Box3d& boxOf(size_t place) const { return boxes[order[place]]; }
    size_t makeNode(size_t begin, size_t end);
  };

  const Scene& scene_;
  const Tracer& tracer_;
  double margin_ = 0;  // between regions and the planes that divide them (world units)
  Tree tree_;
  std::vector<uint32_t> all_;     // the positions of all boxes
  std::vector<uint32_t> never_;   // those of empty boxes
  std::unique_ptr<Region> root_;  // null: too few boxes
  std::unique_ptr<std::mutex> dividing_ = std::make_unique<std::mutex>();
};

}  // namespace rsphere
