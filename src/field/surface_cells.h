#pragma once
// A hierarchy of cells on surfaces, which depends only on the scene. Each cell has a site: a point of the
// surface at which light can be gathered for the surroundings of the cell.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "field/hemisphere.h"
#include "scene/scene.h"

namespace rsphere {

// A point of a surface where indirect light is needed.
struct SurfacePlace {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};  // unit, geometric (not perturbed), on the side where the light arrives
  SurfaceId surface;
  const PlacementPath* path = nullptr;  // instances that contain the surface; null: none
  double distance = 0;                  // length of the ray that hit the place (world units)
};

// Identifies a cell: surface, side, level and indices.
struct CellKey {
  SurfaceId surface{0};
  int32_t level = 0;
  int64_t i = 0, j = 0;
  uint64_t chart = 0;  // identifies the side of the surface and the instances that contain it
  bool operator==(const CellKey&) const = default;
  uint64_t hash(int shift = 0) const;  // the same for all cells of a square of 2^shift x 2^shift
  // Squares of 8 x 8 cells have buckets side by side, so that those of a surface fill few cache lines.
  uint64_t bucket() const { return hash(3) ^ static_cast<uint64_t>((i & 7) << 3 | (j & 7)); }
};

// Parameters that all charts of a scene share.
struct CellGrid {
  double size = 1;      // longest side of the scene's bounds, and side of a cell of level 0 (world units)
  double lift = 0;      // height of sites above their surface (world units), larger than rounding errors
  V3d origin{0, 0, 0};  // a corner of the bounds

  static constexpr int kLevels = 40;
  std::array<double, kLevels + 1> sides{};  // index: level (world units)

  CellGrid(const Box3d& bounds);
  // The approximate side of the cells of a level (world units). Each level halves it.
  double side(int level) const { return sides[static_cast<size_t>(level)]; }
  // The first level whose cells are at most this wide.
  int levelOf(double side) const;
};

// A coordinate system (world units) on the surface that contains a place. For a polygon it is aligned with
// the longest edge, so that the cells of a rectangle have their sites on the rectangle. Spheres and cones
// have charts on their outsides only.
class SurfaceChart {
 public:
  // Empty for surfaces without cells: meshes, the insides of curved surfaces, and spheres and cones within
  // instances. The scene and the path of the place must outlive the chart.
  static std::optional<SurfaceChart> of(const Scene& scene, const CellGrid& grid, const SurfacePlace& place);

  // A chart of the plane through the place, which all surfaces in that plane share. It is used for surfaces
  // that are too small for separate cells. Its sites need not lie on any surface.
  static SurfaceChart ofPlane(const CellGrid& grid, const SurfacePlace& place);

  double u() const { return u_; }  // of the place
  double v() const { return v_; }
  // The longer side of the surface; the radius of a sphere; the larger radius of a cone; infinite for
  // ofPlane().
  double extent() const;
  // The shorter side of a bounded flat surface; infinite otherwise.
  double shorterSide() const { return width_ > 0 ? std::min(width_, height_) : HUGE_VAL; }
  // Makes cells divide the shorter side into at least this many parts. These cells and their keys differ from
  // those before the call. REQUIRES a finite shorterSide().
  void divideAcross(int parts);
  bool isCurved() const { return ball_ || cone_; }
  // A site at a relative position, from 0 to 1 in each coordinate of the chart; for a sphere, a chart covers
  // a sixth of it. Empty if that point does not lie on the surface. REQUIRES a chart that is not from
  // ofPlane().
  std::optional<GatherSite> siteWithin(const CellGrid& grid, const Imath::V2d& shares) const;
  bool isShared() const { return isShared_; }  // by all surfaces in the plane

  // Sides of the cells of a level. A whole number of cells fills each side of a bounded surface.
  double stepU(const CellGrid& grid, int level) const;
  double stepV(const CellGrid& grid, int level) const;
  // The cell of a level that contains these coordinates; outside of the surface, the nearest cell.
  CellKey cellAt(const CellGrid& grid, int level, double u, double v) const;
  // The cell with these indices; outside of the surface, the nearest cell.
  CellKey cell(const CellGrid& grid, int level, int64_t i, int64_t j) const;
  // A site at a relative position in a cell, from 0 to 1 in each coordinate, just above the surface. Empty if
  // that point does not lie on the surface.
  std::optional<GatherSite> siteIn(const CellGrid& grid, const CellKey& key, const Imath::V2d& shares) const;
  // The site of a cell, just above the surface. Empty if none of the points tried in the cell lies on the
  // surface.
  std::optional<GatherSite> site(const CellGrid& grid, const CellKey& key) const;

 private:
  // Each sets the chart to that of a shape at a place on it. Returns false if the shape has no chart there.
  bool setBall(const Sphere& ball, const SurfacePlace& place);
  bool setCone(const Cone& cone, const SurfacePlace& place);
  bool setPolygon(const Polygon& polygon, const SurfacePlace& place);
  bool setRing(const Ring& ring, const SurfacePlace& place);
  void setNormal(V3d normal, const SurfacePlace& place);
  bool setPlace(double width, double height, const V3d& point);
  V3d toWorld(const V3d& p) const;
  bool holds(const V3d& point) const;
  std::optional<GatherSite> siteAt(const CellGrid& grid, double u, double v) const;

  const Scene* scene_ = nullptr;
  SurfaceId surface_;
  bool isShared_ = false;
  uint64_t id_ = 0;
  V3d origin_{0, 0, 0}, x_{1, 0, 0}, y_{0, 1, 0}, normal_{0, 0, 1};
  double width_ = 0, height_ = 0;  // size along x_ and y_, from origin_; 0: unbounded
  int leastU_ = 1, leastV_ = 1;    // smallest number of cells along each side
  double u_ = 0, v_ = 0;
  std::optional<Placement> placement_;
  const Sphere* ball_ = nullptr;
  const Cone* cone_ = nullptr;
  // A sphere has six charts, the faces of a cube around it. A face is given by the axis normal to it, and the
  // sign of its direction along that axis.
  int axis_ = 2;
  double sign_ = 1;
};

}  // namespace rsphere
