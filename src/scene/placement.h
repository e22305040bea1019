#pragma once
#include <Imath/ImathBox.h>

#include <array>
#include <cstdint>

#include "rad_parser/transforms/xform.h"
#include "scene/shape.h"

namespace rsphere {

// The transform between the coordinates of an octree or mesh (inner) and those in which it is placed (outer).
// Scales are positive even for mirror images. As in RADIANCE, normals are transformed like any other vector,
// so that no surface is turned inside out.
struct Placement {
  rad::Similarity toOuter, toInner;

  // Both map unit vectors to unit vectors.
  V3d directionToOuter(const V3d& d) const { return toOuter.vector(d) * toInner.scale; }
  V3d directionToInner(const V3d& d) const { return toInner.vector(d) * toOuter.scale; }
};

// The composition of two placements; inner is nested in outer.
inline Placement within(const Placement& outer, const Placement& inner) {
  return {inner.toOuter * outer.toOuter, outer.toInner * inner.toInner};
}

// The bounding box of a transformed box.
inline Box3d placed(const Placement& placement, const Box3d& box) {
  Box3d result;
  if (box.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.extendBy(
        placement.toOuter.point(V3d(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                    corner & 4 ? box.max.z : box.min.z)));
  return result;
}

// The placements of the instances that contain an object, outermost first; empty for an object in the scene
// itself. Hits and rays store a path and copy it often. Most paths are empty, so entries beyond `count` are
// neither initialized nor copied.
struct PlacementPath {
  static constexpr size_t kDeepest = 16;  // deeper nesting of instances is an error
  uint8_t count = 0;
  std::array<uint32_t, kDeepest> placements;  // indices in Scene::placements; `count` of them

  PlacementPath() {}
  PlacementPath(const PlacementPath& other) { *this = other; }
  PlacementPath& operator=(const PlacementPath& other) {
    count = other.count;
    for (uint8_t i = 0; i < count; ++i) placements[i] = other.placements[i];
    return *this;
  }
};

}  // namespace rsphere
