#pragma once
// Nearest hits and shadows in a scene, by Embree.
//
// Every primitive is one user geometry primitive whose callback works in double precision: RADIANCE's own
// polygon rules hold, nothing is triangulated, and Embree builds and walks one tree. Embree's own
// single-precision work only finds candidates: the scene is recentred, bounds are padded by more than its
// rounding can move a ray, and rays start where they enter the scene. Triangles in single precision, the
// rival, miss the right primitive on 17% of rays once a scene lies 1e5 units from the origin.
//
// An octree or a mesh has a tree of its own, in its own coordinates. An instance is a primitive whose
// callback asks that tree with the ray transformed in double precision, to any depth: Embree's own instances,
// the rival, transform in single precision and would be a second type of tree. Rays do not hit what is nearer
// than kSamePlace to their origin in the units of the octree or mesh (as RADIANCE); ties are judged in the
// world's.
//
// Threads: a Tracer is not changed by queries; any number of threads may ask at once.
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

inline constexpr double kFarAway = 1e10;  // RADIANCE's infinity: the length of a ray that hits nothing

struct Hit {
  int32_t surface = kNone;  // index in Scene::surfaces
  double distance = kFarAway;
  V3d normal{0, 0, 0};  // unit, on the surface's front side
  double cosine = 0;    // -normal . direction: positive where the front was hit
  // Of a mesh: the difference of the interpolated normal from the triangle's, and local coordinates; else 0.
  V3d perturbation{0, 0, 0};
  double u = 0, v = 0;
  // What the surface's modifiers are placed by; empty where they are the world's own.
  PlacementPath path{};
};

enum class Shadow : uint8_t {
  clear,     // nothing is between the two
  blocked,   // something that lets no ray pass is, and nothing before it that could refract the ray past it
  unsure,    // nothing opaque, but something that may let light pass: the ray must be followed
  refracted  // something opaque, but before it something that may refract the ray past it: it must be
             // followed
};

class Tracer {
 public:
  // Keeps a reference to the scene. backFacesVisible (-bv): whether an opaque material stops rays from
  // behind. Throws rad::Error (Status::system) where Embree has no memory left.
  Tracer(const Scene& scene, bool backFacesVisible);
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  // The nearest surface farther than kSamePlace and not beyond farthest (world units) along the unit vector
  // direction, or a Hit of surface kNone. Among surfaces within kSamePlace of one another RADIANCE's choice
  // is made: one with a material, then one that no ray can pass, then one hit from its front, then the one
  // with the later modifier. What is hit in an octree or a mesh counts as the surface that brings it in where
  // that one has a modifier of its own.
  // from: index of a surface that the ray begins on; where it is plane, the ray cannot meet it again. The
  // answer depends on it by rounding alone.
  Hit nearest(const V3d& origin, const V3d& direction, double farthest = kFarAway,
              int32_t from = kNone) const;

  // What lies between origin and a light source's surface at the given distance along direction. source:
  // index of that surface; a distant source is no surface to hit, and distance is kFarAway.
  // blocker: what stopped the ray before, to be tried first, and then what stopped this one (kNoBlocker:
  // nothing): rays to one source, one after the other, are often stopped by the same surface. The answer does
  // not depend on it. from: as for nearest().
  Shadow shadow(const V3d& origin, const V3d& direction, double distance, int32_t source,
                uint32_t* blocker = nullptr, int32_t from = kNone) const;
  static constexpr uint32_t kNoBlocker = ~0u;

  // Whether a surface stops every shadow ray that meets its front, or its back. Other rays may get through
  // all the same: through prisms, and through the backs of light sources where they are not seen (-bv).
  bool stopsShadows(int32_t surface, bool front) const;

  // Whether nothing at all lies between origin and a place at the distance (world units) along the unit
  // vector direction: nothing that could stop a shadow ray, refract it or let it pass.
  bool isClear(const V3d& origin, const V3d& direction, double distance) const;

  // What there is to hit, each octree and mesh counted once.
  size_t primitives() const;

  // Of all surfaces but distant ones; empty where there is none.
  const Box3d& bounds() const { return bounds_; }

  // Where to look for small objects: around a point of a surface. Lengths in world units, the normal a unit
  // vector.
  struct Neighborhood {
    V3d point, normal;
    double radius = 0;
    double widest = 0;     // objects wider than this along any axis are not small
    double thickness = 0;  // what lies within this of the plane through the point belongs to the surface
  };
  // Whether the bounds of a small object come within the radius. Surfaces in instances count one by one, and
  // so does an instance that is small itself; a mesh is one object.
  bool anySmallNear(const Neighborhood& around) const;

 private:
  class Tree;
  struct Embree;

  const Scene& scene_;
  bool backFacesVisible_;
  std::unique_ptr<Embree> embree_;
  Box3d bounds_;
};

}  // namespace rsphere
