#pragma once
#include <Imath/ImathVec.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sphere/predicates.h"

// Spherical Voronoi cells: the solid angle of all directions that are closest to a given direction.
//
// Properties of all functions here that take directions:
// 1. Directions are unit vectors, with |p|^2 within kUnitTolerance (1e-14) of 1. For any other, NaN or
//    infinite direction, std::invalid_argument names its index in the list. Components below 2^-150 are set
//    to 0.
// 2. Only the direction of the stored triple matters; rounding of its length does not.
// 3. A cell's relative error is at most 1e-13, or the effect of changing the input by half an ulp, whichever
//    is larger. The sum is 4 pi within 1e-13 for up to 4096 directions, and within 1e-12 for up to a million.
// 4. Reordering or rotating the directions changes nothing beyond this error.
// 5. Callers need not treat special cases:
//    - No direction: no area. One direction: 4 pi. Two: 2 pi each, wherever they are.
//    - Three or more on one great or small circle: lunes.
//    - All in one hemisphere, in a cap of any size, antipodes, cocircular directions, regular solids.
//    - Equal directions are merged and share the area equally. Directions closer than about 2e-16 may be
//      merged too (5e-15 if the tolerance of lengths is exhausted), and some cells in such a cluster may be
//      0.
// 6. At most 2^29 directions; about 300 bytes each.
// Threads: a BaseTriangulation may be shared once built; a VoronoiWorkspace belongs to one thread at a time.
namespace rsphere {

using Imath::V3d;

class VoronoiWorkspace;

// Directions with their triangulation and areas, copied by every query. Building takes 0.2 us per direction.
class BaseTriangulation {
 public:
  explicit BaseTriangulation(std::span<const V3d> directions);
  ~BaseTriangulation();

 private:
  friend class VoronoiWorkspace;
  friend std::span<const double> cellSolidAngles(const BaseTriangulation&, std::span<const V3d>,
                                                 VoronoiWorkspace&);
  struct Data;
  std::unique_ptr<const Data> data_;
};

// One thread's memory for queries, with the triangulation of the last query. A query allocates memory only if
// it needs more than all earlier ones.
class VoronoiWorkspace {
 public:
  VoronoiWorkspace();
  ~VoronoiWorkspace();
  VoronoiWorkspace(VoronoiWorkspace&&) noexcept;
  VoronoiWorkspace& operator=(VoronoiWorkspace&&) noexcept;

  // Number of predicates that each stage decided in the last query.
  const PredicateCounts& counts() const;

 private:
  friend class BaseTriangulation;
  friend std::span<const double> cellSolidAngles(const BaseTriangulation&, std::span<const V3d>,
                                                 VoronoiWorkspace&);
  friend std::span<const double> cellSolidAngles(std::span<const V3d>, VoronoiWorkspace&);
  friend struct VoronoiCells voronoiCells(const VoronoiWorkspace&);
  struct Data;
  std::unique_ptr<Data> data_;
};

// Solid angles [sr] of the cells of base directions and dynamic directions in a common triangulation, base
// directions first. Returns a view into the workspace, valid until its next use. Only cells next to dynamic
// directions are recomputed.
std::span<const double> cellSolidAngles(const BaseTriangulation& base, std::span<const V3d> dynamicDirections,
                                        VoronoiWorkspace& workspace);

// Solid angles [sr] of the cells of these directions, without base directions.
std::span<const double> cellSolidAngles(std::span<const V3d> directions, VoronoiWorkspace& workspace);
std::vector<double> cellSolidAngles(std::span<const V3d> directions);

// The cells themselves. The cell of direction i is the range [first[i], first[i+1]) of neighbour and vertex,
// counterclockwise as seen from outside. neighbour[k] shares a side with i; vertex[k] is the end of that
// side, and the start of the side shared with neighbour[k+1]. If four or more directions lie on a circle,
// some vertices are equal within rounding and some sides have no length. A merged direction has the cell of
// the direction mergedInto[i]; for all others mergedInto[i] == i. With two directions, each has one neighbour
// and a meaningless vertex (0, 0, 0); a single direction has neither. Error of a vertex: 1e-15 divided by the
// sine of the smallest angle of its triangle.
struct VoronoiCells {
  std::vector<std::uint32_t> first, neighbour, mergedInto;
  std::vector<V3d> vertex;
};

// The cells of the last query of the workspace.
VoronoiCells voronoiCells(const VoronoiWorkspace& workspace);

}  // namespace rsphere
