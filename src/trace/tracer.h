#pragma once
// Nearest hits and shadows in a scene, by Embree.
//
// Every scene primitive is one Embree user geometry primitive, whose callback intersects it in double
// precision. RADIANCE's own polygon rules therefore hold, nothing is triangulated, and Embree builds and
// traverses one tree. Embree's single-precision arithmetic only finds candidates: the scene is recentred,
// bounds are padded by more than its rounding can move a ray, and rays start where they enter the scene.
// Single-precision triangles were rejected: they miss the right primitive on 17% of rays once a scene
// lies 1e5 units from the origin. If they only find candidates for a test in double precision, they are
// slower than callbacks in all interiors (tests/bench/rtrace/runs/2026-11-23-rays.txt).
//
// Each octree and each mesh has its own tree, in its own coordinates. An instance is a primitive whose
// callback queries that tree with the ray transformed in double precision; instances may be nested. Embree's
// own instances were rejected, because they transform in single precision and would be a second type of tree.
// A ray does not hit anything closer to its origin than kSamePlace in the units of the octree or mesh (as in
// RADIANCE); ties between coincident hits are resolved in world units.
//
// Threads: queries do not change a Tracer, so any number of threads may query at once.
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

struct Hit {
  SurfaceId surface;
  double distance = kFarAway;
  V3d normal{0, 0, 0};  // unit, on the surface's front side
  double cosine = 0;    // -normal . direction: positive where the front was hit
  // Meshes only: the interpolated normal minus the triangle's, and the local coordinates; 0 for other shapes.
  V3d perturbation{0, 0, 0};
  double u = 0, v = 0;
  // The placements that apply to the surface's modifiers; empty if these are in world coordinates.
  PlacementPath path{};
};

enum class Shadow : uint8_t {
  clear,     // nothing lies between the two
  blocked,   // something opaque lies between, and nothing before it could refract the ray past it
  unsure,    // nothing opaque lies between, but something may transmit light: the ray must be followed
  refracted  // something opaque does, but something before it may refract the ray past it: the ray must
             // be followed
};

class Tracer {
 public:
  // Keeps a reference to the scene. backFacesVisible (-bv): whether opaque materials stop rays that hit them
  // from behind. Throws rad::Error (Status::system) if Embree runs out of memory.
  Tracer(const Scene& scene, bool backFacesVisible);
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  // The nearest hit farther than kSamePlace and not beyond farthest (world units) along the unit vector
  // direction; a Hit of surface kNone if there is none. Among surfaces within kSamePlace of one another,
  // RADIANCE's rules decide: a surface with a material wins over one without, then an opaque one over a
  // transparent one, then one hit from its front, then the one whose modifier is defined later. If an
  // instance or a mesh has a modifier, hits on its contents are reported as hits on the instance or mesh.
  // from: the surface that the ray starts on. If it is plane, the ray cannot hit it again. It
  // affects the answer by rounding only.
  Hit nearest(const V3d& origin, const V3d& direction, double farthest = kFarAway,
              SurfaceId from = kNone) const;

  // Visibility between origin and a light source's surface at the given distance along direction. source:
  // that surface, which does not block the ray; kNone if there is none. For a distant source,
  // distance is kFarAway.
  // blocker: on entry, a primitive to test first, usually the one that blocked the last ray to this source,
  // because consecutive rays are often blocked by the same surface. On return, the primitive that blocked
  // this ray, or kNoBlocker. The answer does not depend on it. from: as for nearest().
  Shadow shadow(const V3d& origin, const V3d& direction, double distance, SurfaceId source,
                uint32_t* blocker = nullptr, SurfaceId from = kNone) const;
  static constexpr uint32_t kNoBlocker = ~0u;

  // Whether a surface stops every shadow ray that hits its front, or its back. Other rays may still get
  // through: through prisms, and through the backs of light sources if back faces are invisible (-bv).
  bool stopsShadows(SurfaceId surface, bool front) const;

  // Whether the segment from origin along the unit vector direction, of this length (world units), hits
  // nothing: nothing that could block, refract or transmit a shadow ray.
  bool isClear(const V3d& origin, const V3d& direction, double distance) const;

  // The number of primitives; each octree and each mesh is included once.
  size_t primitives() const;

  // The bounds of all surfaces except distant ones; empty if there are none.
  const Box3d& bounds() const { return bounds_; }

  // The bounds of each surface, instance and mesh of the world that may refract rays.
  const std::vector<Box3d>& refracting() const { return refracting_; }

  // A region around a point of a surface in which small objects are searched for. Lengths are in world
  // units, the normal is a unit vector.
  struct Neighborhood {
    V3d point, normal;
    double radius = 0;
    double widest = 0;     // an object is small if its bounds are at most this wide along every axis
    double thickness = 0;  // polygons and rings in a plane this close to the surface's belong to it
  };
  // Whether the bounds of a small object come within the radius. Each surface in an instance is an object,
  // and so is an instance that is small as a whole; a mesh is one object.
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
