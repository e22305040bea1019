#pragma once
// Which light sources are certainly hidden from a place: in a building, the luminaires of all other storeys.
//
// A source is hidden from a box if a single opaque convex polygon (a slab, a wall) cuts every segment between
// the two. With boxes for both, the segments between their corners decide: where these meet the polygon's
// plane, their convex hull contains the points where all segments do ("shaft culling", Haines and Wallace
// 1991). The source need not be sampled from anywhere in such a box: every shadow ray would be blocked.
//
// The scene is divided into boxes along the planes of such polygons (as cells; Teller and Sequin 1991), where
// points fall and as long as it pays. The division depends on the scene alone.
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "light/sources.h"
#include "trace/tracer.h"
#include "transport/function_ref.h"

namespace rsphere {

class HiddenSources {
 public:
  // Keeps references to all three.
  HiddenSources(const Scene& scene, const Tracer& tracer, const LightSources& lights);
  ~HiddenSources();

  // In ascending order, the light sources that are not certainly hidden from the point. Distant sources are
  // never hidden; an image is hidden if its relay is. Any threads may call it.
  std::span<const LightId> notHiddenFrom(const V3d& point) const {
    return root_ ? find(point) : std::span<const LightId>(all_);
  }

  const std::vector<LightId>& all() const { return all_; }

  // Whether a polygon hides everything in box `to` from everything in box `from`.
  bool hides(const Box3d& from, const Box3d& to) const;

 private:
  // An opaque polygon, and its edges' normals in its plane, which point inward.
  struct Blocker;
  struct Region;

  std::span<const LightId> find(const V3d& point) const;
  const Region& half(const Region& region, int upper) const;
  void divide(Region& region) const;
  bool anyBlocker(const V3d& from, const V3d& to, FunctionRef<bool(const Blocker&)> use) const;
  std::vector<std::pair<Blocker, size_t>> blockersIn(const Region& region) const;
  bool findBlocker(SurfaceId surface, const V3d& from, Blocker& blocker) const;
  bool covers(const Blocker& blocker, const Box3d& from, const Box3d& to) const;
  bool hides(const Box3d& from, const Box3d& to, std::vector<Blocker>& known) const;
  void keepVisible(Region& region, size_t node, std::span<const uint32_t> seen,
                   std::vector<Blocker>& known) const;
  size_t makeNode(size_t begin, size_t end);

  // Sources in a binary tree of bounding boxes: a node has the places from begin to end of order_.
  struct Node {
    Box3d box;
    size_t begin, end;
    size_t second;  // the second child; the first one follows the node. 0: a leaf
  };

  const Scene& scene_;
  const Tracer& tracer_;
  double margin_ = 0;  // between regions and the planes that divide them (world units)
  std::vector<LightId> all_;
  std::vector<LightId> always_;  // those that are never hidden
  std::vector<LightId> order_;   // the others, so that near ones lie side by side
  std::vector<Box3d> boxes_;     // of these
  std::vector<Node> nodes_;
  std::unique_ptr<Region> root_;  // null: too few sources
  mutable std::mutex dividing_;
};

}  // namespace rsphere
