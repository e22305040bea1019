#pragma once
#include <Imath/ImathVec.h>

#include <cstdint>

#include "sphere/two_parts.h"

// Which side of a triangle's circle a direction lies on, decided rightly and consistently for all input.
//
// The object. A stored triple p stands for the point q = 2p / (1 + |p|^2). The denominator is the first step
// of Newton's root from 1, so q is the direction of p at radius 1 - e^2/8, where e = |p|^2 - 1: within 2e-32
// of the unit sphere for vectors normalized in double precision, 1.3e-29 for the worst that is let in (|e| <=
// 1e-14). The hull of the points q is what is decided: polynomial in the stored doubles, so exact arithmetic
// can end every doubt. Rounded unit vectors taken as they are were refused: their radii differ by 1e-16,
// which decides the hull where spacing is below 1e-8.
//
// Points of one plane are told apart by a symbolic shift, that of a point with lexicographically greater
// coordinates infinitely larger: first along the radius, then (where all points lie on a great circle) along
// x, y and z.
namespace rsphere {

using Imath::V3d;

// Greatest | |p|^2 - 1 | of a direction, and the radius error that follows from it.
inline constexpr double kUnitTolerance = 1e-14;

// Components below it count as zero: fifth powers of the rest neither overflow nor underflow in exact
// arithmetic.
inline constexpr double kSmallestComponent = 0x1p-150;

// |p|^2 - 1, to 1e-32 and to 2^-51 of itself where p is a normalized vector.
inline double lengthExcess(const V3d& p) {
  const auto [xx, xLow] = product(p.x, p.x);
  const auto [yy, yLow] = product(p.y, p.y);
  const auto [zz, zLow] = product(p.z, p.z);
  const auto [s, sLow] = sum(xx, yy);
  const auto [t, tLow] = sum(s, zz);
  return (t - 1) + (((tLow + sLow) + zLow) + (yLow + xLow));
}

// How often each stage gave the answer. filter: the triangle's stored plane, in floating point with an error
// bound. lifted: coordinates relative to the direction asked for, insensitive to radii. exact: expansions.
// symbolic: ties.
struct PredicateCounts {
  std::uint64_t filter = 0, lifted = 0, exact = 0, symbolic = 0;
};

// Does the circle through a, b, c (counterclockwise as seen from outside the hull) hold p inside?
// Requires four different triples within kUnitTolerance of unit length without components below
// kSmallestComponent other than 0. Always answers; never the same for p inside and for p seen from the
// opposite orientation (b, a, c). Counts the stage that answered. Source of the expansions: Shewchuk,
// "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997.
bool circleHolds(const V3d& a, const V3d& b, const V3d& c, const V3d& p, PredicateCounts& counts);

}  // namespace rsphere
