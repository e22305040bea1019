#pragma once
// Light sources as the direct calculation (next-event estimation) samples them.
#include <optional>
#include <variant>
#include <vector>

#include "base/overloaded.h"
#include "light/beam.h"
#include "scene/scene.h"

namespace rsphere {

// A polygon or a ring. Samples are drawn in the unit square, with coordinates s and t, and mapped to the
// source.
struct PlaneLight {
  // To center + (2s-1) u + (2t-1) v.
  struct Parallelogram {};
  // For a concave polygon, by the same formula: to a square of equal area, partly outside the polygon.
  struct Square {};
  // To the disk with radii u and v, preserving area.
  struct Disk {};
  // To a convex polygon, as a fan of triangles around its first vertex, by area.
  struct Fan {
    std::vector<double> areas;  // cumulative shares of the triangles
    std::vector<V3d> vertices;
  };

  V3d normal{0, 0, 0};  // unit
  double area = 0;
  V3d u{0, 0, 0}, v{0, 0, 0};       // of Square and Fan: half the sides of a square of equal area
  double extentU = 0, extentV = 0;  // half the source's size along u and v, which decides how it is split
  std::variant<Parallelogram, Square, Disk, Fan> map{};
};
// A sphere. Samples are drawn in the cone of directions that it subtends.
struct BallLight {};
// A cylinder. Samples are drawn along its axis and across, as seen from the point.
struct TubeLight {
  V3d half{0, 0, 0};  // from the center to one end
  double area = 0;    // length times diameter
};
// A cone of directions.
struct DistantLight {
  double sinHalfAngle = 0, cosHalfAngle = 1;
};
// A visitor that lacks an answer for one of them does not compile.
using LightShape = std::variant<PlaneLight, BallLight, TubeLight, DistantLight>;
// The number of shapes and of maps. Code that asks for one of them alone asserts it, and so fails to compile
// for a new one until it was read again.
inline constexpr size_t kLightForms =
    std::variant_size_v<LightShape> + std::variant_size_v<decltype(PlaneLight::map)>;

// A surface that is sampled by the direct calculation: light, spotlight, illum, and glow within its reach. If
// the scene has importance goals, the goals are the only sources.
//
// Virtual sources are the images of other sources in a relay (mirror, prism1, prism2). An image has a
// position and an extent, and can only be seen through its relay.
struct LightSource {
  SurfaceId surface{};   // of a virtual source, its relay, which a ray to it hits first
  LightId relayed{};     // the source that a ray reaches from the relay; kNone: a real source
  int32_t image = 0;     // which of its relay's images, from 0
  V3d center{0, 0, 0};   // of a distant source, the direction to it (unit)
  double radius = 0;     // of its bounding sphere around center (world units); 0 for distant sources
  double outermost = 0;  // the largest distance of its points from center; a sine if distant
  double reach = 0;      // beyond this distance (world units) it lights nothing directly; 0: no limit
  std::optional<Spotlight> spot{};
  // Of a virtual source: every point that it lights lies in the beam, as seen from the image's center. A
  // distant image has no center; its beam holds all directions.
  Beam beam{};
  // Rays need no intersection test with the source. Either it is real and flat, and the unit square maps into
  // it, so that a ray hits it exactly where it was aimed; or it is a sphere that shines outward.
  bool hitsWhereAimed = false;
  LightShape shape{};

  bool isVirtual() const { return relayed != kNone; }
  bool isDistant() const { return as<DistantLight>(); }
  // The shape if it is of this type, otherwise null.
  template <class S>
  const S* as() const {
    return std::get_if<S>(&shape);
  }
};

// The source that a surface is, without the reach and the spot of its material. REQUIRES that the surface is
// not an instance or a mesh.
LightSource lightSourceOf(const Scene& scene, SurfaceId surface);

// Sets the extents of a source from its other members.
void measure(PlaneLight& light);

// Half the width of a tube across its axis, as seen along a vector.
inline V3d acrossTube(const TubeLight& tube, const V3d& along) {
  return tube.half.cross(along).normalized() * (tube.area / (4 * tube.half.length()));
}

// Whether rays that are aimed at the shape hit it. A goal may have any shape; one that cannot be aimed at is
// only hit by chance.
bool canBeAimedAt(ShapeRef shape, const Scene& scene);

}  // namespace rsphere
