#pragma once
#include <Imath/ImathBox.h>
#include <Imath/ImathVec.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <type_traits>
#include <variant>

#include "base/overloaded.h"

namespace rsphere {

using Imath::Box3d;
using Imath::V3d;

// Hits closer together than this along a ray are treated as coincident, and hits closer to the ray's origin
// are ignored (world units). The value is RADIANCE's, on which scenes with coincident surfaces rely.
inline constexpr double kSamePlace = 1e-6;

// kSamePlace for a scene, octree or mesh with these bounds: smaller if the surfaces are so small that
// kSamePlace would be visible, but never below the rounding errors of hits.
double samePlaceIn(const Box3d& bounds);

// The rounding errors of hits on surfaces with these bounds, with a margin for rays at small angles to them.
double roundingIn(const Box3d& bounds);

// The length of a ray that hits nothing (world units): RADIANCE's infinity.
inline constexpr double kFarAway = 1e10;

// A hit on a shape. normal: unit, on the front side, even if the back was hit. cosine: -normal . direction,
// positive if the front was hit. The members are not initialized, because every ray creates a ShapeHit.
struct ShapeHit {
  double distance;
  V3d normal;
  double cosine;
};

// A plane polygon, which may be concave or have holes that are connected by a seam. A point is inside if a
// line from it to infinity crosses the boundary an odd number of times. If the vertices are not coplanar, the
// polygon lies in their mean plane (RADIANCE reference manual, "polygon"). Only data for intersection tests
// are stored, because large scenes consist of polygons; areaOf() and thicknessOf() compute the rest.
struct Polygon {
  static constexpr uint32_t kMostVertices = (1u << 29) - 1;
  V3d normal{0, 0, 1};       // unit, by the right-hand rule; Newell's sum over the vertices
  double offset = 0;         // normal . p for points p of the plane
  uint32_t firstVertex = 0;  // range in Scene::vertices
  uint32_t vertices : 29 = 0;
  uint32_t axis : 2 = 2;     // index of the largest component of normal
  uint32_t hasArea : 1 = 0;  // if 0, it is never hit
  float extent = 0;          // sum of the bounding box's sizes along the two other axes, rounded up
};

// inward: the front is inside (bubble).
struct Sphere {
  V3d center{0, 0, 0};
  double radius = 1;
  bool inward = false;
};

// Cone, cup, cylinder or tube between two planes across its axis. inward: the front is inside (cup, tube).
struct Cone {
  V3d base{0, 0, 0};
  V3d axis{0, 0, 1};  // unit, from base to the other end
  double length = 1;
  double radius0 = 1, radius1 = 1;  // at base, at the other end
  bool inward = false;
};

// A flat disk, or a ring if inner is above 0.
struct Ring {
  V3d center{0, 0, 0};
  V3d normal{0, 0, 1};
  double inner = 0, outer = 1;
};

// A cone of directions at infinity: "source". The tracer does not contain it; rays that hit nothing else see
// it.
struct Distant {
  V3d direction{0, 0, 1};  // unit, towards it
  double halfAngle = 0;    // radians, at most pi
  double cosHalfAngle = 1;
  double solidAngle = 0;  // sr

  // Whether a ray in the direction d (unit) sees the source. Solid angles are compared in single precision,
  // as in rtrace: 2 pi is rounded up, so that a hemisphere extends 2.8e-8 radians below the horizon. In
  // double precision, rounding would leave a gap between a sky and a ground of 180 degrees each.
  bool isSeenAlong(const V3d& d) const {
    constexpr double kTwoPi = 2 * std::numbers::pi;
    return kTwoPi * (1 - direction.dot(d)) <= static_cast<float>(kTwoPi * (1 - cosHalfAngle));
  }
};

// An octree placed by "instance".
struct Instance {
  uint32_t placement = 0;  // index in Scene::placements
  uint32_t group = 0;      // index in Scene::groups
};

// A mesh file placed by "mesh".
struct MeshInstance {
  uint32_t placement = 0;  // index in Scene::placements
  uint32_t mesh = 0;       // index in Scene::meshes
};

// The triangles of a mesh with the same material from the mesh file. Rays hit them through instances of the
// mesh.
struct MeshFaces {};

using Shape = std::variant<Polygon, Sphere, Cone, Ring, Distant, Instance, MeshInstance, MeshFaces>;
// Code that handles only one type of shape asserts this number: it stops compiling when a type is added,
// until somebody has checked it.
inline constexpr size_t kShapes = std::variant_size_v<Shape>;

// Every shape is Distant, a PlainShape or a NestedShape. These two concepts list their types, so that
// visitors that use them do not compile for a new type of shape until it is added to a list or handled
// separately. Rays intersect a plain shape directly, by one of the functions below.
template <class S>
concept PlainShape = OneOf<S, Polygon, Sphere, Cone, Ring>;
// Rays intersect the contents of the shape, or part of them.
template <class S>
concept NestedShape = OneOf<S, Instance, MeshInstance, MeshFaces>;

// Refers to a shape that is stored elsewhere as a Shape or as a bare Polygon.
class ShapeRef {
 public:
  ShapeRef(const Shape& shape) : polygon_(std::get_if<Polygon>(&shape)), shape_(&shape) {}
  ShapeRef(const Polygon& polygon) : polygon_(&polygon) {}

  // The shape if it has this type, otherwise null.
  template <class S>
  const S* as() const {
    if constexpr (std::is_same_v<S, Polygon>)
      return polygon_;
    else
      return shape_ ? std::get_if<S>(shape_) : nullptr;
  }

  // Calls a visitor with the shape, like std::visit().
  template <class Visitor>
  friend decltype(auto) visit(Visitor&& visitor, ShapeRef shape) {
    return shape.polygon_ ? visitor(*shape.polygon_) : std::visit(visitor, *shape.shape_);
  }

 private:
  const Polygon* polygon_ = nullptr;
  const Shape* shape_ = nullptr;  // null for a bare polygon
};

inline bool isPlain(ShapeRef shape) {
  return match(
      shape, [](const PlainShape auto&) { return true; }, [](const Distant&) { return false; },
      [](const NestedShape auto&) { return false; });
}

// The normal of a polygon or ring; null for other shapes.
inline const V3d* planeNormal(ShapeRef shape) {
  using Answer = const V3d*;
  return match(
      shape, [](const OneOf<Polygon, Ring> auto& flat) -> Answer { return &flat.normal; },
      [](const OneOf<Sphere, Cone, Distant> auto&) -> Answer { return nullptr; },
      [](const NestedShape auto&) -> Answer { return nullptr; });
}
// Whether the normal is the same everywhere. As in RADIANCE, this includes faces of meshes.
inline bool isFlat(ShapeRef shape) {
  return match(
      shape, [](const OneOf<Polygon, Ring, MeshFaces> auto&) { return true; },
      [](const OneOf<Sphere, Cone, Distant, Instance, MeshInstance> auto&) { return false; });
}
// normal . p for points p of the plane; 0 for shapes that are not plane.
double planeOffset(ShapeRef shape);

// Whether the shape encloses a volume, so that it is seen from one side only. The ends of cones are open.
bool isClosed(ShapeRef shape);

// The area of one side (square world units). For a cone, the slant height is approximated by the length of
// the axis. 0 for shapes that are not plain.
double areaOf(ShapeRef shape, std::span<const V3d> vertices);
double areaOf(const Polygon& polygon, std::span<const V3d> vertices);

// The largest distance of a vertex from the plane.
double thicknessOf(const Polygon& polygon, std::span<const V3d> vertices);

// The mean of the vertices.
V3d centerOf(const Polygon& polygon, std::span<const V3d> vertices);

// Whether the ray hits the shape at a distance above `nearest` and up to `farthest`. hit: the nearest such
// point; unchanged if there is none. Distances are accurate to a few ulp of the largest coordinate involved.
// As in RADIANCE, a ray misses a plane if its cosine to the normal is at most kSamePlace.
inline bool intersect(const Polygon& polygon, std::span<const V3d> vertices, const V3d& origin,
                      const V3d& direction, double farthest, ShapeHit& hit, double nearest = kSamePlace);
bool intersect(const Sphere& sphere, const V3d& origin, const V3d& direction, double farthest, ShapeHit& hit,
               double nearest = kSamePlace);
bool intersect(const Cone& cone, const V3d& origin, const V3d& direction, double farthest, ShapeHit& hit,
               double nearest = kSamePlace);
bool intersect(const Ring& ring, const V3d& origin, const V3d& direction, double farthest, ShapeHit& hit,
               double nearest = kSamePlace);

// The smallest box around the shape, up to rounding. Not for Distant.
Box3d bounds(const Polygon& polygon, std::span<const V3d> vertices);
Box3d bounds(const Sphere& sphere);
Box3d bounds(const Cone& cone);
Box3d bounds(const Ring& ring);

// intersect() and bounds() for any shape: no hit and an empty box if the shape is not plain.
bool intersect(ShapeRef shape, std::span<const V3d> vertices, const V3d& origin, const V3d& direction,
               double farthest, ShapeHit& hit, double nearest = kSamePlace);
Box3d bounds(ShapeRef shape, std::span<const V3d> vertices);

// Computes the polygon's plane and axis from its vertices (at least 3). It has no area if they are collinear.
Polygon makePolygon(std::span<const V3d> vertices, uint32_t first, uint32_t count);

// Whether a point of the polygon's plane is inside. This includes points on the boundary, and those within
// rounding or `tolerance` (world units) of it.
bool inside(const Polygon& polygon, std::span<const V3d> vertices, const V3d& point, double tolerance = 0);

// Whether a ray that meets the polygon's plane at this distance and cosine (as in ShapeHit) hits the polygon.
bool meetsInside(const Polygon& polygon, std::span<const V3d> vertices, const V3d& origin,
                 const V3d& direction, double distance, double cosine);

// The plane test is inline, because most tested polygons already fail it.
inline bool intersect(const Polygon& polygon, std::span<const V3d> vertices, const V3d& origin,
                      const V3d& direction, double farthest, ShapeHit& hit, double nearest) {
  const double cosine = -polygon.normal.dot(direction);
  if (std::abs(cosine) <= kSamePlace) return false;
  const double t = (polygon.normal.dot(origin) - polygon.offset) / cosine;
  if (!(t > nearest && t <= farthest)) return false;
  if (!meetsInside(polygon, vertices, origin, direction, t, cosine)) return false;
  hit = {t, polygon.normal, cosine};
  return true;
}

}  // namespace rsphere
