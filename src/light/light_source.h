#pragma once
// Light sources as next-event estimation (RADIANCE's direct calculation) samples them.
#include <algorithm>
#include <cmath>
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
  // For a concave polygon that shines: to a square of equal area that lies partly outside the polygon, by the
  // formula of Parallelogram, as in rtrace.
  struct Square {};
  // To the disk with radii u and v, preserving area.
  struct Disk {};
  // To a polygon that is divided into triangles, preserving area: around its first vertex if it is convex.
  // Only importance goals may be concave.
  struct Triangles {
    std::vector<double> areas;  // cumulative fractions of the polygon's area
    std::vector<V3d> vertices;  // three of each triangle

    // A point of triangle i. s: square of the share of the way from its first vertex to the opposite side.
    V3d at(size_t i, double s, double t) const {
      const double root = std::sqrt(s);
      return (1 - root) * vertices[3 * i] + root * (1 - t) * vertices[3 * i + 1] +
             root * t * vertices[3 * i + 2];
    }
    // The triangle at this fraction of the area.
    size_t triangleAt(double s) const {
      return static_cast<size_t>(std::upper_bound(areas.begin(), areas.end() - 1, s) - areas.begin());
    }
  };

  V3d normal{0, 0, 0};  // unit
  double area = 0;
  V3d u{0, 0, 0}, v{0, 0, 0};       // of Square and Triangles: half the sides of a square of equal area
  double extentU = 0, extentV = 0;  // half the source's size along u and v, which determines how it is split
  std::variant<Parallelogram, Square, Disk, Triangles> map{};
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
// A visitor that does not handle all of these types does not compile.
using LightShape = std::variant<PlaneLight, BallLight, TubeLight, DistantLight>;
// The number of shapes and maps. Code that handles only one of them asserts this number, so that adding a
// shape makes that code fail to compile until someone has checked it.
inline constexpr size_t kLightForms =
    std::variant_size_v<LightShape> + std::variant_size_v<decltype(PlaneLight::map)>;

// A surface that is sampled by the direct calculation: light, spotlight, illum, and glow within its reach. If
// the scene has importance goals, the goals are the only sources.
//
// Virtual sources are the images of other sources in a relay (mirror, prism1, prism2). An image has a
// position and an extent, and can only be seen through its relay.
struct LightSource {
  SurfaceId surface{};  // of a virtual source: its relay, which a ray to the source hits first
  LightId relayed{};    // the source that the relay shows; kNone: this is a real source
  int32_t image = 0;    // index among the images that its relay makes of that source
  V3d center{0, 0, 0};  // of a distant source, the direction to it (unit)
  double radius = 0;    // of its bounding sphere around center (world units); 0 for distant sources
  // Largest distance of its points from center; for a distant source, the sine of its half-angle.
  double outermost = 0;
  double reach = 0;  // beyond this distance (world units) it lights nothing directly; 0: no limit
  std::optional<Spotlight> spot{};
  // Of a virtual source: a beam from the image's center that contains every point the source lights. A
  // distant image has no center; its beam contains all directions.
  Beam beam{};
  // Every ray aimed at a sample of the source hits it, so that no intersection test is needed. True if the
  // source is real and flat and the unit square maps into it, or if it is a sphere that shines outward.
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

// The light source that a surface forms, without the reach and the spotlight that its material sets.
// REQUIRES that the surface is not an instance or a mesh.
LightSource lightSourceOf(const Scene& scene, SurfaceId surface);

// Computes the members extentU and extentV from the others.
void measure(PlaneLight& light);

// A vector from a tube's axis to its outline as seen along a direction. Its length is the tube's radius.
inline V3d acrossTube(const TubeLight& tube, const V3d& along) {
  return tube.half.cross(along).normalized() * (tube.area / (4 * tube.half.length()));
}

// Whether rays that are aimed at the shape hit it. Importance goals may have other shapes, which are hit only
// by chance.
bool canBeAimedAt(ShapeRef shape, const Scene& scene);

}  // namespace rsphere
