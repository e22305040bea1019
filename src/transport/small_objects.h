#pragma once
// Where a scene has objects so small that the sites of interpolation may miss them.
//
// Cells of interpolation are as wide as the distances that a few rays from their sites find. On open ground
// these rays miss a bench ten metres away, and with it the shadow that it throws. So a cell is divided where
// it has an object beside it that is smaller than itself, until it is as small as the object.
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scene/scene.h"
#include "trace/tracer.h"
#include "transport/surface_cells.h"

namespace rsphere {

class SmallObjects {
 public:
  // Keeps nothing of the scene or the tracer. finest: the side of the smallest cells that are asked for
  // (world units). Surfaces in instances count one by one, up to two million in all; a mesh counts as one
  // object, and so does an instance beyond them.
  SmallObjects(const Scene& scene, const Tracer& tracer, const CellGrid& grid, double finest);

  // Whether an object smaller than the side (world units) lies within about that distance of the site, and
  // not in the site's own plane: tiles of a floor do not count on that floor. False for cells below `finest`.
  bool anyNear(const GatherSite& site, double side) const;

 private:
  // What a cube of space holds: surfaces of one plane, or others.
  struct Content {
    bool onePlane = true;
    V3d normal{0, 0, 0};  // unit
    double offset = 0;    // of the plane from the world's origin, along the normal (world units)
    void add(const Content& other, double lift);
    bool liesIn(const V3d& planeNormal, double planeOffset, double lift) const;
  };
  struct Cube {
    int64_t i, j, k;
    bool operator==(const Cube&) const = default;
  };
  struct CubeHash {
    size_t operator()(const Cube& cube) const;
  };
  using Cubes = std::unordered_map<Cube, Content, CubeHash>;

  void addGroup(const Scene& scene, const Tracer& tracer, size_t group, const Placement* placement,
                size_t& left);
  void add(const Box3d& box, const Content& content);
  Cube cubeOf(const V3d& point, int level) const;

  CellGrid grid_;
  int coarsest_, finest_;     // levels of CellGrid
  std::vector<Cubes> cubes_;  // from the coarsest level on
};

}  // namespace rsphere
