#pragma once
// The directions in which an object may be seen from a point.
#include <span>
#include <vector>

#include "scene/shape.h"

namespace rsphere {

// A region on the sphere of directions that holds every direction in which the object can be seen, and can be
// sampled evenly: a cap, or a convex spherical polygon. For spheres, distant sources and convex polygons it
// is the silhouette itself; for rings, cones and cylinders the convex hull of their circles' polygons (1.5%
// wider at most, but for a ring's hole) where they are seen within a cone of
// tuning::Silhouettes::kWidestHull, else a cap around them; for other polygons a cap.
class Silhouette {
 public:
  // No direction at all.
  Silhouette() = default;

  // What the object itself fills, sr: exact to rounding for spheres and polygons (0 in the polygon's plane, 4
  // pi inside a sphere), for cones, cylinders and rings the region's. Vertices out of a polygon's plane count
  // where rays meet it, in its mean plane.
  double solidAngle() const { return solidAngle_; }
  // What the region fills, sr; not less than solidAngle().
  double regionSolidAngle() const { return regionSolidAngle_; }

  // direction: unit. Within rounding of the edge (2e-15 rad, up to 1e-8 where a polygon reaches round half of
  // the sphere) it counts as inside, so that what sample() returns always does.
  bool contains(const V3d& direction) const;

  // A direction of the region, even by solid angle for even u1, u2 in [0, 1]. Source for polygons: Arvo,
  // "Stratified Sampling of Spherical Triangles" (SIGGRAPH 1995). REQUIRES regionSolidAngle() > 0.
  V3d sample(double u1, double u2) const;

  // A cap that holds the region, and its half angle (radians; pi: it may be anywhere).
  struct Cap {
    V3d axis{0, 0, 1};
    double angle = 0;
  };
  Cap surroundingCap() const;

  // The directions of both regions, exactly where both are polygons; else the smaller region of the two.
  Silhouette within(const Silhouette& other) const;

  friend Silhouette silhouetteOf(const Shape& shape, std::span<const V3d> vertices, const V3d& point);
  friend Silhouette hullOf(std::span<const V3d> around, const V3d& point);

 private:
  void setCap(const V3d& axis, double versine);
  void setBall(const V3d& center, double radius, const V3d& point);
  void setPolygon(const Polygon& polygon, std::span<const V3d> vertices, const V3d& point);
  bool setConvex(std::span<const V3d> corners, const V3d& point);
  bool setHull(std::span<const V3d> points, const V3d& point);

  double solidAngle_ = 0, regionSolidAngle_ = 0;
  V3d axis_{0, 0, 1};
  double versine_ = 0;          // 1 - cos(half angle) of the cap; exact where cos would round it away
  double squaredChord_ = 0;     // between the cap's axis and its edge, rounding added
  std::vector<V3d> corners_;    // of a convex polygon; empty: a cap
  std::vector<V3d> sides_;      // its sides' inward normals, unit
  double slack_ = 0;            // rad: how far outside them rounding may put a direction
  std::vector<double> shares_;  // cumulative solid angles of the triangles around corner 0
};

// The silhouette of a shape as seen from a point (world). vertices: Scene::vertices.
Silhouette silhouetteOf(const Shape& shape, std::span<const V3d> vertices, const V3d& point);

// The convex hull of places (world) as seen from a point: empty where they do not span one, or one wider than
// tuning::Silhouettes::kWidestHull.
Silhouette hullOf(std::span<const V3d> around, const V3d& point);

// Solid angle of a plane polygon, concave or with holes by a seam, as seen from a point, sr: 0 where the
// point lies in its plane, or so near (1e-12 world units, or rounding of the coordinates) that no ray from
// there hits it. Error 1e-15 a vertex and, for small ones, 1e-15 a vertex of itself over the sine at which
// the polygon is seen. Source: Van Oosterom and Strackee 1983, IEEE Trans. Biomed. Eng. 30/2, summed with
// signs.
double polygonSolidAngle(std::span<const V3d> vertices, const V3d& point);

}  // namespace rsphere
