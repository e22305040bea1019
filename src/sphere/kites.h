#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "sphere/delaunay.h"

// Solid angles of Voronoi cells, from the Delaunay triangles around a direction. A triangle with corners a,
// b, c and circumcentre n contributes a kite to the cell of each corner: corner, middle of one edge, n,
// middle of the other edge. Its area is signed, since n may lie outside the triangle. Half a kite, at edge
// bc, is half an isosceles triangle b, c, n:
//   tan = |b-c|^2 (b-a).(c-a) / ((4 - |b-c|^2) N + 4 k),  k = det(a, b, c),
//   N^2 = k^2 + (|a-b| |b-c| |c-a| / 2)^2,
// where N is twice the area of the plane triangle and k/N the cosine of the circle's radius. All terms are
// computed from differences of sites, k from the two shortest edges, so the result is accurate for any size.
// Rounding leaves a site at a height h (up to 2e-16) above the sphere, to which k is insensitive. For edges u
// and v whose heights rise by d_u and d_v, the values for the exact directions are
//   |u|^2 - d_u^2  and  u.v + (|u|^2 d_v + |v|^2 d_u)/2 - d_u d_v
// Without this correction, the error is 5e-12 for a needle with sides of 0.1 and 1e-6, and 1e-9 for cells at
// the edge of a cluster. Fans of Girard's, L'Huilier's, Eriksson's and Van Oosterom-Strackee's formulas were
// rejected, because their relative error is 1e-3 at a spacing of 1e-6.
namespace rsphere {

// The areas of the kites of a triangle's three corners [sr].
using Kites = std::array<double, 3>;

// Smallest usable cosine of a circle's radius (84 degrees). In wider circles the kites are unusable, because
// both parts of the tangent are near 0 or the branch is wrong. carefulSolidAngle() handles them.
inline constexpr double kLeastCosine = 0.1;

// Computes the kites of the listed triangles. wide[i] is 1 if the circle of triangle which[i] is too wide.
// All three spans have equal lengths. A cell that is the sum of such kites has a relative error of 1e-14, if
// the circles are not much wider than the cell.
void computeKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, std::span<Kites> kites,
                  std::span<std::uint8_t> wide);

// Adds the kites of the listed triangles to the areas of their corners [sr], and marks the corners of
// triangles whose circles are too wide.
void addKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, std::span<double> area,
              std::span<std::uint8_t> spoiled);

// The cell of a site [sr] in extended precision. If a circle is too wide, the cell is computed from the
// hull's angles at the site: it is 2 pi minus their sum, because they are the sides of its polar dual.
double carefulSolidAngle(const Delaunay& delaunay, std::uint32_t site);

// The angle at c between a and b on the hull [rad], in extended precision.
long double hullAngle(const Site& a, const Site& b, const Site& c);

// The unit normal of the triangle, which is the Voronoi vertex that its corners share.
V3d circumcentre(const V3d& a, const V3d& b, const V3d& c);

}  // namespace rsphere
