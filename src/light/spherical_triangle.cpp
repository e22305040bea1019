#include "light/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

// The point on the arc from b to c whose versine (1 - cosine of its angle from b) is this fraction of c's
// versine. The area of a spherical cap is proportional to its versine, so uniform fractions give uniform
// areas.
V3d alongArc(const V3d& b, const V3d& c, double share) {
  const V3d difference = c - b;
  const double whole = difference.length2() / 2;  // 1 - cosine, without cancellation
  const V3d across = difference + whole * b;
  const double length = across.length();
  if (!(length > 0)) return b;
  const double versine = share * whole;
  return ((1 - versine) * b + std::sqrt(versine * (2 - versine)) / length * across).normalized();
}

}  // namespace

double triangleSolidAngle(const V3d& a, const V3d& b, const V3d& c, const V3d& point) {
  const V3d toA = a - point, toB = b - point, toC = c - point;
  const double la = toA.length(), lb = toB.length(), lc = toC.length();
  return 2 * std::atan2(toA.dot((b - a).cross(c - a)),
                        la * lb * lc + toA.dot(toB) * lc + toB.dot(toC) * la + toC.dot(toA) * lb);
}

V3d sampleTriangle(const V3d& a, const V3d& b, const V3d& c, double solidAngle, double u1, double u2) {
  const V3d across = (c - a) - (c - a).dot(a) * a;
  const double length = across.length();
  if (!(length > 0)) return alongArc(b, a, u2);
  const V3d e = across / length;
  const double half = u1 * solidAngle / 2;
  // If b is near a or nearly opposite to it, sums and differences of the vectors keep digits that products of
  // the vectors would lose.
  const bool near = a.dot(b) > 0;
  const double onePlus = (a + b).length2() / 2, volume = std::abs(e.dot(a.cross(near ? b - a : b + a)));
  const double whole = std::atan2(c.dot(e), c.dot(a));
  const double angle = std::min(
      whole, 2 * std::atan2(std::sin(half) * onePlus, std::cos(half) * volume - std::sin(half) * b.dot(e)));
  return alongArc(b, std::cos(angle) * a + std::sin(angle) * e, u2);
}

}  // namespace rsphere
