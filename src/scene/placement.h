#pragma once
#include <Imath/ImathBox.h>

#include <array>
#include <cstdint>
#include <span>

#include "rad_parser/xform.h"
#include "scene/shape.h"

namespace rsphere {

// Where an octree or a mesh lies in what holds it. Scales are positive, mirrored or not: as in RADIANCE, a
// mirroring transform takes normals along like any other vector, so that no surface is turned round.
struct Placement {
  rad::Similarity toOuter, toInner;

  // Unit vectors to unit vectors.
  V3d directionToOuter(const V3d& d) const { return toOuter.vector(d) * toInner.scale; }
  V3d directionToInner(const V3d& d) const { return toInner.vector(d) * toOuter.scale; }
};

// inner lies in what outer places.
Placement within(const Placement& outer, const Placement& inner);

// The box around a placed box.
Box3d placed(const Placement& placement, const Box3d& box);

// The placements between the world and a thing that is placed within others, the outermost first. Every ray
// has one, most of them empty: what is not used is neither set nor copied.
struct PlacementPath {
  static constexpr size_t kDeepest = 16;  // instances within each other beyond this are refused
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
