#pragma once
// Opaque polygons that hide one box from another. See hidden_boxes.h.
//
// A polygon hides a box from another if it intersects every segment between them. It is enough to test the
// segments between corners: the convex hull of their intersections with the polygon's plane contains the
// intersections of all segments ("shaft culling", Haines and Wallace 1991). Polygons of one plane that touch
// count as one. Segments through a hole must be blocked by the next polygon (portal sequences: Teller and
// Sequin 1991).
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "base/function_ref.h"
#include "occluders/joined_polygons.h"
#include "trace/tracer.h"

namespace rsphere {

// A convex polygon, with the inward normals of its edges in its plane, or an area of several polygons.
struct Blocker {
  // Polygons with more vertices are rarely convex. They are only treated as part of an area.
  static constexpr uint32_t kMostVertices = 8;

  SurfaceId surface;
  V3d normal{0, 0, 0};  // unit, towards the side from which a ray hit it
  double offset = 0;
  uint32_t edges = 0;  // 0: only the area hides boxes
  std::array<V3d, kMostVertices> inward{};
  std::array<double, kMostVertices> least{};  // of each edge: inward . p for points p of the edge
  int axis = -1;                              // index of the axis normal to the polygon's plane; -1: none

  // The area, or the polygon alone if it belongs to none. Blockers::wholeOf() looks it up.
  struct Whole {
    const JoinedPolygons::Area* area = nullptr;  // null: the polygon alone
    Box3d box{};
    double size = 0;  // half the sum of its extents along two axes
  };
  mutable std::once_flag lookedUp;
  mutable Whole whole;
};
using KnownBlocker = std::shared_ptr<const Blocker>;

class Blockers {
 public:
  // Keeps references to the scene and the tracer.
  Blockers(const Scene& scene, const Tracer& tracer);

  // covers() may treat a point up to kBeside times margin() from a blocker that is perpendicular to an axis
  // as if it were that far in front of it. margin(): world units.
  static constexpr double kBeside = 2.25;
  double margin() const { return margin_; }
  const Box3d& bounds() const { return tracer_.bounds(); }

  // Whether a blocker hides everything in box `to` from everything in box `from`. known: blockers that were
  // found for nearby boxes, beginning with the one that hid a box last. fromBothEnds: if the first surfaces
  // between the boxes have holes, the last ones are examined, too. In a tall building with holes in its
  // slabs, often only the last slab hides a box.
  bool hides(const Box3d& from, const Box3d& to, std::vector<KnownBlocker>& known, bool fromBothEnds) const;

  // Calls use() with each blocker on the way between two points until use() returns true. Returns whether it
  // has returned true.
  bool anyBetween(const V3d& from, const V3d& to, FunctionRef<bool(const KnownBlocker&)> use) const;

  // Looks up the area of a blocker, as seen from its front.
  const Blocker::Whole& wholeOf(const Blocker& blocker) const;

 private:
  KnownBlocker find(SurfaceId id, const V3d& from) const;
  KnownBlocker made(SurfaceId id, const Polygon& polygon, bool front) const;
  struct Way;
  bool covers(const Blocker& blocker, Way& way) const;
  bool isClear(const V3d& from, const V3d& to) const;

  const Scene& scene_;
  const Tracer& tracer_;
  double margin_ = 0;
  JoinedPolygons joined_;
  // Guards the blockers found so far, by surface and side; null for polygons that cannot block.
  mutable std::mutex finding_;
  mutable std::unordered_map<uint64_t, KnownBlocker> found_;
};

}  // namespace rsphere
