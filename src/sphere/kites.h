#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sphere/delaunay.h"

// Solid angles of Voronoi cells from the Delaunay triangles around a direction. A triangle with corners a, b,
// c and circumcentre n gives each corner the kite of corner, middle of one edge, n, middle of the other edge;
// signed, since n may lie outside. Half a kite, at edge bc, is half an isosceles triangle b, c, n:
//   tan = |b-c|^2 (b-a).(c-a) / ((4 - |b-c|^2) N + 4 k),  k = det(a, b, c),
//   N^2 = k^2 + (|a-b| |b-c| |c-a| / 2)^2,
// N being twice the area of the plane triangle and k/N the cosine of the circle's radius. All from
// differences of sites, k from the two shortest edges: right for any size. Rounding leaves a site at height h
// above the sphere (up to 2e-16); k does not feel it, and for an edge that rises by d,
//   |u|^2 - d^2  and  u.v + (|u|^2 d_v + |v|^2 d_u)/2 - d_u d_v
// are those of the directions. Without it a needle with sides of 0.1 and 1e-6 is wrong by 5e-12, and the
// cells at the edge of a cluster by 1e-9. Girard, L'Huilier, Eriksson and Van Oosterom-Strackee fans were
// refused: 1e-3 relative error at 1e-6 spacing.
namespace rsphere {

// Kites of the three corners [sr].
using Kites = std::array<double, 3>;

// A circle wider than this (radius 84 degrees: the cosine is below 0.1) spoils kites, which are then of no
// use: the tangent has both parts near 0, or the wrong branch. carefulSolidAngle has the answer.
inline constexpr double kLeastCosine = 0.1;

// Computes the kites of the listed triangles. wide[i] is 1 where the circle of triangle which[i] is too wide.
// All three have the same length. Relative error of a cell that sums them: 1e-14 where circles are not much
// wider than the cell.
void computeKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, std::span<Kites> kites,
                  std::span<std::uint8_t> wide);

// Adds the kites of the listed triangles to their corners' areas [sr], and marks the corners of too wide
// ones.
void addKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, std::span<double> area,
              std::span<std::uint8_t> spoiled);

// The cell of a site [sr] in extended precision, from the angles at the hull's vertex where a circle is wide:
// the cell is 2 pi less their sum, since its polar dual has them as sides.
double carefulSolidAngle(const Delaunay& delaunay, std::uint32_t site);

// Angle at c between a and b on the hull [rad], extended precision.
long double hullAngle(const Site& a, const Site& b, const Site& c);

// Unit normal of the triangle: the Voronoi vertex that its corners share.
V3d circumcentre(const V3d& a, const V3d& b, const V3d& c);

}  // namespace rsphere
