#pragma once
// Finds boxes that are certainly hidden from a place, such as the luminaires on all other storeys of a
// building.
//
// A box is hidden from another if an opaque slab or wall intersects every segment between them (blockers.h).
// A light source in a hidden box need not be sampled, since every shadow ray would be blocked.
//
// The scene is divided into regions along the planes of such polygons (cells: Teller and Sequin 1991). A
// region is divided when a point in it is first looked up, and only if that saves time. The result depends
// only on the scene and the boxes.
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "occluders/blockers.h"
#include "scene/box_tree.h"

namespace rsphere {

class HiddenBoxes {
 public:
  // boxes: fewer than 2^32; empty boxes are never hidden. few: up to this number of boxes, all are treated as
  // visible, because finding hidden ones would take more time than it saves.
  HiddenBoxes(std::shared_ptr<const Blockers> blockers, std::vector<Box3d> boxes, size_t few);
  ~HiddenBoxes();
  HiddenBoxes(HiddenBoxes&&) noexcept;

  // The indices of the boxes that are not certainly hidden from the point, in ascending order. May be called
  // from any thread.
  std::span<const uint32_t> notHiddenFrom(const V3d& point) const { return root_ ? find(point) : all_; }
  std::span<const uint32_t> all() const { return all_; }

  // notHiddenFrom() for a point of a surface that faces `front` (unit), for callers that ignore boxes behind
  // the surface: the result may or may not contain them. For points on slabs and walls, this finds more
  // hidden boxes.
  std::span<const uint32_t> notHiddenFrom(const V3d& point, const V3d& front) const {
    return root_ ? find(beside(point, front)) : all_;
  }

  // The result for the largest region around the point for which enough(result) is true; if it is never true,
  // for the smallest region.
  std::span<const uint32_t> widestWhere(const V3d& point,
                                        FunctionRef<bool(std::span<const uint32_t>)> enough) const;

  // Whether the scene may be divided into regions, so that some boxes may be hidden.
  bool divides() const;

  // The blockers, which HiddenBoxes with other boxes of this scene may share.
  const std::shared_ptr<const Blockers>& blockers() const { return blockers_; }

 private:
  struct Region;

  V3d beside(const V3d& point, const V3d& front) const;
  std::span<const uint32_t> find(const V3d& point) const;
  const Region& half(const Region& region, int upper) const;
  void divide(Region& region) const;
  void findVisible(Region& region) const;
  std::vector<std::pair<KnownBlocker, size_t>> blockersIn(const Region& region) const;
  std::vector<uint32_t> visibleFrom(const Box3d& region, std::span<const uint32_t> places,
                                    std::vector<KnownBlocker>& known) const;

  std::shared_ptr<const Blockers> blockers_;
  BoxTree tree_;
  std::vector<uint32_t> all_;     // indices of all boxes
  std::unique_ptr<Region> root_;  // null if there are too few boxes
  std::unique_ptr<std::mutex> dividing_ = std::make_unique<std::mutex>();
};

}  // namespace rsphere
