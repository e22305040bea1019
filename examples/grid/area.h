#pragma once
#include <Imath/ImathVec.h>

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "rad_parser/description.h"

namespace grid {

using Imath::V2d;
using Imath::V3d;
using Ring = std::vector<V2d>;

struct Edge {
  V2d from, to;
};

// The plane of an area, with coordinates (u, v) in units of the scene. Of a horizontal plane u and v are x
// and y; of others u runs to the right and v upwards as seen from the front, from the lower left corner.
struct Plane {
  V3d origin, right, up;
  V3d normal;  // unit, of the side that is measured

  V3d at(const V2d& p, double height = 0) const;
  V2d project(const V3d& p) const;
  bool horizontal() const;
};

// One polygon, or several in one plane that serve as one surface (a floor of triangles, for instance). Holes,
// seams and overlaps are allowed.
class Area {
 public:
  // REQUIRES: at least one ring, each of at least 3 vertices.
  Area(const Plane& plane, const std::vector<Ring>& rings);

  const Plane& plane() const { return plane_; }
  // The boundary: edges with the area on their left and nothing on their right. Seams of holes and edges
  // between polygons are not part of it.
  const std::vector<Edge>& edges() const { return edges_; }
  // Inside one of the polygons by RADIANCE's rule, an odd number of crossings.
  bool contains(const V2d& p) const;
  double distanceToEdge(const V2d& p) const;

 private:
  // The edges of a ring by horizontal strips, so that a point is compared with those of its strip alone.
  class Rows {
   public:
    explicit Rows(const Ring& ring);
    bool contain(const V2d& p) const;

   private:
    size_t rowAt(double y) const;

    double low_ = std::numeric_limits<double>::infinity(), step_ = 0;
    std::vector<std::vector<Edge>> rows_;
  };

  Plane plane_;
  std::vector<Rows> rings_;
  std::vector<Edge> edges_;
};

// The area of the polygons of these names. If no polygon has a name, it stands for the polygons with the
// modifier of that name. reversed: the back is measured. upOnly: only those of these polygons that face up,
// such as the tops of boxes. Throws rad::Error if there is no such polygon, with the names that resemble it,
// and if the polygons lie in different planes.
Area findArea(const rad::Description& scene, std::span<const std::string> names, bool reversed,
              bool upOnly = false);

// The outlines of all polygons of these names or modifiers, projected on the plane. Throws rad::Error as
// findArea() does.
std::vector<Ring> findOutlines(const rad::Description& scene, std::span<const std::string> names,
                               const Plane& plane);

struct PolygonCorners {
  std::string name, modifier;  // printable; the modifier is void if there is none
  std::vector<V3d> corners;
};

// All polygons of the scene, in its order. Those inside of instances and meshes are not among them.
std::vector<PolygonCorners> allPolygons(const rad::Description& scene);

}  // namespace grid
