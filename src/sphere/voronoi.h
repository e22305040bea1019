#pragma once
#include <Imath/ImathVec.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sphere/predicates.h"

// Spherical Voronoi cells: the solid angle for which each direction stands, being the nearest.
//
// Properties of every function here that takes directions:
// 1. Directions are unit vectors; |p|^2 may differ from 1 by kUnitTolerance (1e-14). One that is farther
//    from it, NaN or infinite: std::invalid_argument, which names its place in the list. Components below
//    2^-150 count as 0.
// 2. What counts is the direction of the stored triple; rounding of its length does not matter.
// 3. A cell's relative error is at most 1e-13, or what a change of the input by half an ulp can do to it,
//    whichever is greater. The sum is 4 pi within 1e-13 to 4096 directions, 1e-12 to a million.
// 4. Order and rotation do not matter beyond that.
// 5. One direction: 4 pi. Two: 2 pi each, wherever they are. Three or more on one great or small circle:
//    lunes. Equal directions are merged and share the area equally. Directions nearer than about 2e-16 may be
//    merged too (5e-15 if their lengths use the tolerance up), and some cells in a crowd of them be 0. All
//    in one hemisphere, in a cap of any size, antipodes, cocircular ones and those of regular solids need
//    no care. No direction: no area.
// 6. At most 2^29 directions; about 300 bytes each.
// Threads: a BaseTriangulation may be shared once built; a VoronoiWorkspace belongs to one thread at a time.
namespace rsphere {

using Imath::V3d;

class VoronoiWorkspace;

// Directions whose triangulation and areas are kept, to be copied for each query. Takes 0.2 us a direction to
// build.
class BaseTriangulation {
 public:
  explicit BaseTriangulation(std::span<const V3d> directions);
  ~BaseTriangulation();
  BaseTriangulation(BaseTriangulation&&) noexcept;
  BaseTriangulation& operator=(BaseTriangulation&&) noexcept;

  std::span<const V3d> directions() const;
  std::span<const double> solidAngles() const;  // [sr], in the order of the directions

 private:
  friend class VoronoiWorkspace;
  friend std::span<const double> cellSolidAngles(const BaseTriangulation&, std::span<const V3d>,
                                                 VoronoiWorkspace&);
  struct Data;
  std::unique_ptr<const Data> data_;
};

// Memory of one thread for queries and the triangulation of its last one. Queries allocate only where they
// exceed all before them.
class VoronoiWorkspace {
 public:
  VoronoiWorkspace();
  ~VoronoiWorkspace();
  VoronoiWorkspace(VoronoiWorkspace&&) noexcept;
  VoronoiWorkspace& operator=(VoronoiWorkspace&&) noexcept;

  // How the last query's predicates were answered.
  const PredicateCounts& counts() const;

 private:
  friend class BaseTriangulation;
  friend std::span<const double> cellSolidAngles(const BaseTriangulation&, std::span<const V3d>,
                                                 VoronoiWorkspace&);
  friend std::span<const double> cellSolidAngles(std::span<const V3d>, VoronoiWorkspace&);
  friend struct VoronoiCells voronoiCells(const VoronoiWorkspace&);
  friend std::optional<std::string> voronoiFault(const VoronoiWorkspace&);
  struct Data;
  std::unique_ptr<Data> data_;
};

// Solid angles [sr] of the cells of the base directions, then of the dynamic ones, all together.
// Returns a view into the workspace, valid until its next use. Only cells that dynamic directions touch are
// computed.
std::span<const double> cellSolidAngles(const BaseTriangulation& base, std::span<const V3d> dynamicDirections,
                                        VoronoiWorkspace& workspace);

// Without a base.
std::span<const double> cellSolidAngles(std::span<const V3d> directions, VoronoiWorkspace& workspace);
std::vector<double> cellSolidAngles(std::span<const V3d> directions);

// The cells themselves, direction i's at [first[i], first[i+1]) of the other lists, counterclockwise as seen
// from outside: neighbour[k] shares a side with i, and vertex[k] ends that side, before that of
// neighbour[k+1]. Where four or more directions lie on a circle, vertices are equal within rounding and some
// sides have no length. A merged direction has the cell of the one it was merged into, mergedInto[i]; others
// have mergedInto[i] == i. Two directions: one neighbour each and no vertices that mean anything (0, 0, 0).
// One: neither. Error of a vertex: 1e-15 over the sine of the smallest angle of its triangle.
struct VoronoiCells {
  std::vector<std::uint32_t> first, neighbour, mergedInto;
  std::vector<V3d> vertex;
};

// The cells of the workspace's last query.
VoronoiCells voronoiCells(const VoronoiWorkspace& workspace);

// Checks the last query: each triangle's circle holds no corner of its neighbours (for a closed surface that
// is enough for none to hold any direction), the surface is closed, areas are not negative and sum to 4 pi
// within 1e-12. Returns what is wrong, or nothing. Takes about as long as building anew.
std::optional<std::string> voronoiFault(const VoronoiWorkspace& workspace);

}  // namespace rsphere
