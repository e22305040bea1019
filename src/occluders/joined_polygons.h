#pragma once
// Joins opaque polygons that lie in one plane and touch or overlap, such as the panels of a slab, or the
// pieces of a wall around a door. Together they may hide a box that none of them hides alone.
//
// Only the outline of such an area is computed: the parts of edges with opaque polygons on one side only. A
// convex part of the plane lies within the area if one of its points does, and if the outline does not enter
// it. Concave polygons and holes need no special treatment, nor do edges that meet in the middle of others.
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "scene/box_tree.h"
#include "trace/tracer.h"

namespace rsphere {

class JoinedPolygons {
 public:
  class Area {
   public:
    // The number of polygons, and the box around them.
    size_t size() const { return polygons_.size(); }
    const Box3d& box() const { return box_; }
    // False if a point in the area's plane is certainly outside of it, or nearer than `margin` to its edge.
    bool mayContain(const V3d& point, double margin) const {
      for (int i = 0; i < 3; ++i)
        if (i != axis_ && (point[i] < box_.min[i] + margin || point[i] > box_.max[i] - margin)) return false;
      return true;
    }
    // Whether the convex hull of points in the area's plane lies within the area, at least `margin` away from
    // its outline (world units).
    bool contains(std::span<const V3d> points, double margin) const;
    // Boxes around the holes in a rectangular area. Empty if the area has no holes or is not rectangular.
    const std::vector<Box3d>& holes() const { return holes_; }

   private:
    friend class JoinedPolygons;
    struct Segment {
      V3d begin{0, 0, 0}, end{0, 0, 0};
    };
    const Scene* scene_ = nullptr;
    int axis_ = 2;  // of the largest component of the plane's normal
    Box3d box_{};
    std::vector<Segment> outline_;
    std::vector<Box3d> holes_;
    BoxTree outlineTree_;
    std::vector<SurfaceId> polygons_;
    BoxTree polygonTree_;
  };

  // Keeps references.
  JoinedPolygons(const Scene& scene, const Tracer& tracer);
  ~JoinedPolygons();

  // The area of this polygon and all polygons connected to it that stop shadow rays from the side in front of
  // it (front), or behind it. Null if the polygon is convex and no other polygon of its plane touches the box
  // around it, and for polygons that are not quite plane. Only for polygons of the scene itself. May be
  // called from any thread; the result is valid as long as this object.
  const Area* areaOf(SurfaceId polygon, bool front) const;

 private:
  // A polygon, and the number of its plane.
  struct InPlane {
    uint64_t plane;
    SurfaceId polygon;
  };
  // The areas of some polygons in a plane that are seen from one side of it.
  struct Areas {
    std::vector<Area> areas;
    std::unordered_map<uint32_t, size_t> areaOf;  // by index of the polygon
  };
  // The areas of a whole plane. Polygons whose boxes touch form a group, and the areas of a group are found
  // when they are first needed: in a tall building, surfaces of all storeys lie in one plane.
  struct Plane {
    std::vector<std::vector<SurfaceId>> groups;
    std::vector<std::unique_ptr<const Areas>> areas;  // of each group, null if not yet found
    std::unordered_map<uint32_t, size_t> groupOf;     // by index of the polygon
  };
  class Joining;

  void sort() const;
  Plane groupsOf(std::span<const InPlane> plane, double side) const;

  const Scene& scene_;
  const Tracer& tracer_;
  mutable std::once_flag sorted_;
  mutable std::vector<InPlane> polygons_;  // in ascending order
  mutable std::mutex joining_;
  mutable std::unordered_map<uint64_t, std::unique_ptr<Plane>> planes_;
};

}  // namespace rsphere
