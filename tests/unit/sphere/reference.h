#pragma once
#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

// Solid angles in quad precision by a way of its own: no triangulation, no predicates, no kites.
//
// The cell of c is the intersection of hemispheres, one for each other direction b. Its polar dual is the
// hull of the directions b - c. These all lie below c's tangent plane, so the hull is that of plane points:
// b's part in the tangent plane over the depth of b below it. The cell is 2 pi less the dual's perimeter or,
// where small, a fan of triangles. Directions that are nearly on that hull do not matter, so rounding cannot
// spoil it. Relative error 1e-30 over the distance to the nearest direction.
namespace rsphere {

using Imath::V3d;
#ifdef __SIZEOF_FLOAT128__
using Quad = __float128;
#else  // arm64
using Quad = long double;
#endif
static_assert(sizeof(Quad) == 16);

class Reference {
 public:
  // Normalizes the directions in quad precision. Equal triples share a cell.
  explicit Reference(std::span<const V3d> directions);

  Quad solidAngle(std::size_t i) const;

  // The greatest change of direction i's solid angle in a few trials that move each coordinate of all
  // directions near it by half an ulp up or down.
  Quad changeByHalfUlp(std::size_t i) const;

 private:
  struct Point {
    Quad x, y, z;
  };
  static Point normalized(const V3d& d);
  std::vector<std::uint32_t> candidates(std::size_t i) const;
  Quad cell(const Point& c, std::span<const Point> others, double* radius) const;

  std::vector<V3d> directions_;
  std::vector<Point> points_;
  std::vector<std::uint32_t> sharers_, representative_;
  // Buckets of a grid on [-1, 1]^3, to find near directions among a million.
  int grid_ = 1;
  std::vector<std::vector<std::uint32_t>> buckets_;
  int bucketOf(double x) const;
};

}  // namespace rsphere
