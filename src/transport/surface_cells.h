#pragma once
// Surfaces divided into cells, by the scene alone: each cell has a site, a point of the surface at which
// light can be gathered for what lies around it.
#include <cstdint>
#include <optional>

#include "scene/scene.h"
#include "transport/hemisphere.h"

namespace rsphere {

// A point of a surface that indirect light is asked for.
struct SurfacePlace {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};  // unit, of the surface itself, on the side that the light arrives at
  int32_t surface = kNone;
  const PlacementPath* path = nullptr;  // of the surface; null: it lies in the world itself
  double distance = 0;                  // that the ray came from (world units)
};

// Which cell of which surface, and on which side.
struct CellKey {
  int32_t surface = 0, level = 0;
  int64_t i = 0, j = 0;
  uint64_t chart = 0;  // of the side, and of what places the surface
  bool operator==(const CellKey&) const = default;
  uint64_t hash() const;
};

// What all charts of a scene have in common.
struct CellGrid {
  double size = 1;      // the longest side of the scene's bounds; of the cells of level 0 (world units)
  double lift = 0;      // of sites above their surface (world units): more than rounding can hide
  V3d origin{0, 0, 0};  // a corner of the bounds

  CellGrid(const Box3d& bounds);
  static constexpr int kLevels = 40;
  double side(
      int level) const;  // of the cells of a level, about (world units); each level's is half the last one's
  int levelOf(double side) const;  // the first whose cells are not larger
};

// Coordinates (world units) on the surface that a place lies on. Polygons and rings have a frame of their
// own, along the longest edge, so that no site lies beside them; balls and cones are charted from outside.
class SurfaceChart {
 public:
  // Empty for what has no cells: meshes, insides of what is curved, placed balls and cones. Keeps references
  // to the scene and the place's path, for as long as it is used.
  static std::optional<SurfaceChart> of(const Scene& scene, const CellGrid& grid, const SurfacePlace& place);

  // The plane that the place lies in, whatever surface it is on: for surfaces that are too small for cells of
  // their own. Its sites may lie beside all surfaces.
  static SurfaceChart ofPlane(const CellGrid& grid, const SurfacePlace& place);

  double u() const { return u_; }  // of the place
  double v() const { return v_; }
  // The longer side of the surface; of a ball or cone the radius; infinite of a plane.
  double extent() const;
  bool isCurved() const { return ball_ || cone_; }
  bool isShared() const { return isShared_; }  // of all surfaces in the plane

  // Sides of the cells of a level: as equal parts of the surface's sides.
  double stepU(const CellGrid& grid, int level) const;
  double stepV(const CellGrid& grid, int level) const;
  // The cell of a level with these coordinates, or the one nearest to them at the surface's edge.
  CellKey cellAt(const CellGrid& grid, int level, double u, double v) const;
  // The cell with these indices, or the one nearest to them at the surface's edge.
  CellKey cell(const CellGrid& grid, int level, int64_t i, int64_t j) const;
  // Lies on the surface; empty where the cell seems to have nothing of it.
  std::optional<GatherSite> site(const CellGrid& grid, const CellKey& key) const;

 private:
  bool holds(const V3d& point) const;
  std::optional<GatherSite> siteAt(const CellGrid& grid, double u, double v) const;

  const Scene* scene_ = nullptr;
  int32_t surface_ = kNone;
  bool isShared_ = false;
  uint64_t id_ = 0;
  V3d origin_{0, 0, 0}, x_{1, 0, 0}, y_{0, 1, 0}, normal_{0, 0, 1};
  double width_ = 0, height_ = 0;  // from the origin on; 0: without end
  double u_ = 0, v_ = 0;
  std::optional<Placement> placement_;
  const Sphere* ball_ = nullptr;
  const Cone* cone_ = nullptr;
  int axis_ = 2;  // of a ball: that its face of a cube is across
  double sign_ = 1;
};

}  // namespace rsphere
