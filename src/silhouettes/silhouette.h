#pragma once
// The directions in which an object may be seen from a point. Some objects matter more than their solid angle
// suggests and get separate directions: light sources in view (seen_sources.h), and objects whose radiance
// varies (special_objects.h).
#include <span>
#include <vector>

#include "scene/shape.h"

namespace rsphere {

// A region of the sphere of directions that contains all directions in which an object is visible, and that
// can be sampled uniformly: a cap or a convex spherical polygon.
// - For spheres, distant sources and convex polygons it is the silhouette itself.
// - For rings, cones and cylinders it is the convex hull of polygons around their circles, at most 1.5% wider
//   than the silhouette, not counting the hole of a ring. If they extend beyond a cone of half angle
//   tuning::Silhouettes::kWidestHull, it is a cap.
// - For other polygons it is a cap.
class Silhouette {
 public:
  Silhouette() = default;

  // The solid angle of the object, sr. For spheres and polygons it is exact to rounding: 0 in the plane of a
  // polygon, 4 pi inside a sphere. For cones, cylinders and rings it is that of the region. Vertices outside
  // the mean plane of a polygon are moved into that plane, where rays hit the polygon.
  double solidAngle() const { return solidAngle_; }
  // The solid angle of the region, sr; not less than solidAngle().
  double regionSolidAngle() const { return regionSolidAngle_; }

  // direction: unit. Directions that rounding puts outside the edge are included, so that those from sample()
  // always are. The tolerance is 2e-15 rad, and up to 1e-8 for a polygon as wide as a hemisphere.
  bool contains(const V3d& direction) const;

  // A direction of the region, uniform by solid angle if u1, u2 are uniform in [0, 1]. REQUIRES
  // regionSolidAngle() > 0. Source for polygons: Arvo, "Stratified Sampling of Spherical
  // Triangles" (SIGGRAPH 1995).
  V3d sample(double u1, double u2) const;

  // A cap that contains the region. angle: half angle, radians; pi: the whole sphere.
  struct Cap {
    V3d axis{0, 0, 1};
    double angle = 0;
  };
  Cap surroundingCap() const;

  // The intersection of the two regions if both are polygons, otherwise the smaller of them.
  Silhouette within(const Silhouette& other) const;

  friend Silhouette silhouetteOf(ShapeRef shape, std::span<const V3d> vertices, const V3d& point);
  friend Silhouette hullOf(std::span<const V3d> around, const V3d& point);

 private:
  void setCap(const V3d& axis, double versine);
  void setBall(const V3d& center, double radius, const V3d& point);
  void setPolygon(const Polygon& polygon, std::span<const V3d> vertices, const V3d& point);
  bool setConvex(std::span<const V3d> corners, const V3d& point);
  bool setHull(std::span<const V3d> points, const V3d& point);

  double solidAngle_ = 0, regionSolidAngle_ = 0;
  struct Around {
    V3d axis{0, 0, 1};
    double versine = 0;       // 1 - cos(half angle); accurate where the cosine rounds to 1
    double squaredChord = 0;  // from the axis to the edge, with rounding added
  };
  Around cap_;
  std::vector<V3d> corners_;    // of the convex polygon; empty: a cap
  std::vector<V3d> sides_;      // inward normals of its sides, unit
  double slack_ = 0;            // tolerance for rounding outside a side, rad
  std::vector<double> shares_;  // cumulative solid angles of the triangles around corner 0
};

// The silhouette of a shape as seen from a point (world). vertices: Scene::vertices.
Silhouette silhouetteOf(ShapeRef shape, std::span<const V3d> vertices, const V3d& point);

// The convex hull of places (world) as seen from a point. Empty if it has no area, or extends beyond a cone
// of half angle tuning::Silhouettes::kWidestHull.
Silhouette hullOf(std::span<const V3d> around, const V3d& point);

// Solid angle (sr) of a plane polygon as seen from a point. The polygon may be concave and may have holes
// that are connected by a seam. 0 if the point lies in the plane, or so close to it (1e-12 world units, or
// rounding of the coordinates) that no ray from there hits the polygon. Error per vertex: 1e-15 sr; for small
// polygons, 1e-15 of the solid angle divided by the sine of the angle between plane and view. Source: Van
// Oosterom and Strackee 1983, IEEE Trans. Biomed. Eng. 30/2, summed with signs.
double polygonSolidAngle(std::span<const V3d> vertices, const V3d& point);

}  // namespace rsphere
