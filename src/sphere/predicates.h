#pragma once
// Decides correctly and consistently on which side of a triangle's circumcircle a direction lies.
//
// The geometric object. A stored triple p represents the point q = 2p / (1 + |p|^2). (1 + |p|^2) / 2 is the
// first Newton iterate for |p|, starting at 1, so q has the direction of p and the radius 1 - e^2/8, where e
// = |p|^2 - 1. The radius is within 2e-32 of 1 for vectors normalized in double precision, and within 1.3e-29
// for all accepted vectors (|e| <= 1e-14). The predicate decides the convex hull of the points q. It is
// polynomial in the stored doubles, so exact arithmetic can decide every case. Rejected alternative: the
// rounded unit vectors themselves, because the differences of 1e-16 in their radii decide the hull at
// spacings below 1e-8.
//
// Ties between coplanar points are broken by a symbolic perturbation. Of two points, the one with
// lexicographically greater coordinates is perturbed by an infinitely larger amount. Points move first along
// the radius, then (if all lie on a great circle) along x, y and z.
#include <Imath/ImathVec.h>

#include <cstdint>

namespace rsphere {

using Imath::V3d;

// Sums and products of two doubles without error (Knuth's sum, Dekker's product): high is the rounded result,
// low its rounding error. Requires that nothing overflows or underflows, and that the compiler does not
// contract products and sums (CMakeLists.txt).
struct TwoParts {
  double high, low;
};

inline TwoParts sum(double a, double b) {
  const double s = a + b, fromB = s - a;
  return {s, (a - (s - fromB)) + (b - fromB)};
}

// Veltkamp's splitting into halves of 26 bits each, so that products of halves are exact.
inline TwoParts halves(double a) {
  const double c = 134217729.0 * a, high = c - (c - a);
  return {high, a - high};
}

inline TwoParts product(double a, double b) {
  const double p = a * b;
  const auto [ah, al] = halves(a);
  const auto [bh, bl] = halves(b);
  return {p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)};
}

// The largest | |p|^2 - 1 | of an accepted direction. It determines the error of the radius.
inline constexpr double kUnitTolerance = 1e-14;

// Smaller components are set to zero, so that fifth powers of the others neither overflow nor underflow in
// exact arithmetic.
inline constexpr double kSmallestComponent = 0x1p-150;

// |p|^2 - 1. For a normalized vector p the error is at most 1e-32, and 2^-51 of the value.
inline double lengthExcess(const V3d& p) {
  const auto [xx, xLow] = product(p.x, p.x);
  const auto [yy, yLow] = product(p.y, p.y);
  const auto [zz, zLow] = product(p.z, p.z);
  const auto [s, sLow] = sum(xx, yy);
  const auto [t, tLow] = sum(s, zz);
  return (t - 1) + (((tLow + sLow) + zLow) + (yLow + xLow));
}

// Number of predicates decided by each stage.
// - filter: the triangle's stored plane, in floating point with an error bound.
// - lifted: coordinates relative to the query direction, insensitive to radii.
// - exact: expansion arithmetic.
// - symbolic: ties.
struct PredicateCounts {
  std::uint64_t filter = 0, lifted = 0, exact = 0, symbolic = 0;
};

// Whether the circle through a, b, c (counterclockwise as seen from outside the hull) contains p. Requires
// four different triples within kUnitTolerance of unit length, whose components are 0 or at least
// kSmallestComponent. Never fails, and the opposite orientation (b, a, c) has the opposite result. Increments
// the counter of the stage that decided. Source of the expansions: Shewchuk, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates", 1997.
bool circleHolds(const V3d& a, const V3d& b, const V3d& c, const V3d& p, PredicateCounts& counts);

}  // namespace rsphere
