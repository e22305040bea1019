#pragma once
// Nearest hits and shadows in a scene, found with Embree.
//
// Every scene primitive is a user geometry primitive of Embree, whose callback intersects it in double
// precision. Polygons therefore follow RADIANCE's rules, nothing is triangulated, and Embree builds and
// traverses a single tree. Embree's single-precision arithmetic only finds candidates: the scene is
// recentred, bounds are padded by more than rounding can move a ray, and rays start where they enter the
// scene. Single-precision triangles were rejected: 17% of rays miss the right primitive if the scene is 1e5
// units from the origin. As candidates for a test in double precision, they are slower than callbacks in all
// interiors (tests/bench/rtrace/runs/2026-11-23-rays.txt).
//
// Each octree and each mesh has a separate tree in its own coordinates. An instance is a primitive whose
// callback queries that tree with the ray transformed in double precision; instances may be nested. Embree's
// instances were rejected, because they transform in single precision and would be a second type of tree. As
// in RADIANCE, a ray ignores hits closer to its origin than kSamePlace in units of the octree or mesh, while
// ties between coincident hits are resolved in world units. Both are less in small scenes (samePlaceIn()).
//
// Threads: queries do not change a Tracer, so any number of threads may query it at the same time.
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// Given instead of the surface on which a ray starts, for a ray that starts in space, as at the points of
// sphere mode. It ignores only hits within rounding errors of its origin.
inline constexpr SurfaceId kInSpace{-2};

struct Hit {
  SurfaceId surface;
  double distance = kFarAway;
  V3d normal{0, 0, 0};  // unit, on the surface's front side
  double cosine = 0;    // -normal . direction: positive where the front was hit
  // Meshes only: the interpolated normal minus the triangle's, and the local coordinates; 0 for other shapes.
  V3d perturbation{0, 0, 0};
  double u = 0, v = 0;
  // The placements of the surface's modifiers; empty if these use world coordinates.
  PlacementPath path{};
};

enum class Shadow : uint8_t {
  clear,     // nothing is in between
  blocked,   // something opaque is in between, and nothing before it may refract the ray past it
  unsure,    // nothing opaque is in between, but something may transmit light: the ray must be followed
  refracted  // something opaque is in between, but something before it may refract the ray past it: the ray
             // must be followed
};

class Tracer {
 public:
  // Keeps a reference to the scene. backFacesVisible (-bv): whether opaque materials stop rays that hit them
  // from behind. Throws rad::Error (Status::system) if Embree runs out of memory.
  Tracer(const Scene& scene, bool backFacesVisible);
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  // The nearest hit beyond Scene::samePlace and up to `farthest` (world units) along the unit vector
  // direction; a Hit with surface kNone if there is none. Among surfaces within Scene::samePlace of one
  // another, RADIANCE's rules decide. In this order, the following take precedence: surfaces with a material,
  // opaque surfaces, surfaces hit from the front, surfaces whose modifier is defined later, and later
  // surfaces. If an instance or a mesh has a modifier, hits on its contents are reported as hits on the
  // instance or mesh. from: the surface on which the ray starts, or kInSpace. If it is plane, the ray cannot
  // hit it again, which changes the result only by rounding.
  Hit nearest(const V3d& origin, const V3d& direction, double farthest = kFarAway,
              SurfaceId from = kNone) const;

  // Visibility between origin and a light source's surface at the given distance along direction. source:
  // that surface, which does not block the ray, or kNone. For a distant source, distance is kFarAway.
  // blocker: on entry, a primitive to test first, usually the one that blocked the last ray to this source,
  // because consecutive rays are often blocked by the same surface; on return, the primitive that blocked
  // this ray, or kNoBlocker. It does not affect the result. from: as for nearest().
  Shadow shadow(const V3d& origin, const V3d& direction, double distance, SurfaceId source,
                uint32_t* blocker = nullptr, SurfaceId from = kNone) const;
  static constexpr uint32_t kNoBlocker = ~0u;

  // Whether a surface stops every shadow ray that hits its front, or its back. Other rays may still pass:
  // prisms, and backs of light sources if back faces are invisible (-bv).
  bool stopsShadows(SurfaceId surface, bool front) const;

  // Whether the segment from origin in the unit direction, of this length (world units), is free of anything
  // that could block, refract or transmit a shadow ray. from: kInSpace, or a surface, which does not matter.
  bool isClear(const V3d& origin, const V3d& direction, double distance, SurfaceId from = kNone) const;

  // The number of primitives, counting each octree and each mesh once.
  size_t primitives() const;

  double samePlace() const { return scene_.samePlace; }

  // The bounds of all surfaces except distant ones; empty if there are none.
  const Box3d& bounds() const { return bounds_; }

  // The bounds of each surface, instance and mesh of the world that may refract rays.
  const std::vector<Box3d>& refracting() const { return refracting_; }

  // A region around a point of a surface, in which to search for small objects. Lengths are in world units;
  // the normal is a unit vector.
  struct Neighborhood {
    V3d point, normal;
    double radius = 0;
    double widest = 0;     // largest width of the bounds of a small object along any axis
    double thickness = 0;  // polygons and rings in planes this close to the surface's plane belong to the
                           // surface
  };
  // Whether the bounds of a small object are within the radius. Every surface in an instance is an object,
  // and so is an instance that is small as a whole; a mesh is a single object.
  bool anySmallNear(const Neighborhood& around) const;

 private:
  class Tree;
  struct Embree;

  const Scene& scene_;
  std::unique_ptr<Embree> embree_;
  Box3d bounds_;
  std::vector<Box3d> refracting_;
};

}  // namespace rsphere
