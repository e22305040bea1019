#include "scene/shape_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/constants.h"

namespace rsphere {
namespace {

using rad::Type;
using rad::Warn;

// The answer for a shape that is left out, with a warning.
std::nullopt_t leftOut(const PrimitiveArguments& a, const Warn& warn, std::string_view why) {
  a.warn(warn, why);
  return std::nullopt;
}

// Throws if a coordinate or size is beyond single precision, in which rays are traced. Its square, or areas
// and distances computed from it, might not be finite.
void needTraceable(const PrimitiveArguments& a) {
  for (const double real : a.reals())
    if (std::abs(real) > std::numeric_limits<float>::max())
      a.fail(fmt::format("{:g} is too large: coordinates and sizes must be below 3.4e38", real));
}

}  // namespace

std::optional<Polygon> readPolygon(const PrimitiveArguments& a, const Warn& warn,
                                   std::span<const V3d> vertices) {
  const size_t reals = a.reals().size();
  if (reals < 9 || reals % 3) a.fail(fmt::format("expected at least 9 coordinates in threes, got {}", reals));
  needTraceable(a);
  size_t count = reals / 3;
  // The last vertex may repeat the first.
  Box3d box;
  for (size_t i = 0; i < reals; i += 3) box.extendBy(a.vector(i));
  if (count > 3 && (a.vector(0) - a.vector(reals - 3)).length() <= samePlaceIn(box)) --count;
  if (vertices.size() > std::numeric_limits<uint32_t>::max() || count >= Polygon::kMostVertices)
    a.fail("more vertices than can be numbered");
  const Polygon polygon = makePolygon(vertices, a.firstVertex(), static_cast<uint32_t>(count));
  const double area = areaOf(polygon, vertices);
  if (area == 0) return leftOut(a, warn, "zero area");
  // Deviations of a thousandth of the size are visible; rounding in files of single precision is far smaller.
  if (thicknessOf(polygon, vertices) > 1e-3 * std::sqrt(area)) a.warn(warn, "non-planar vertex");
  return polygon;
}

std::optional<Shape> readSphere(const PrimitiveArguments& a, const Warn& warn) {
  a.needReals(4);
  needTraceable(a);
  Sphere sphere{a.vector(0), a.reals()[3], a.type() == Type::bubble};
  if (sphere.radius < 0) {
    a.warn(warn, "negative radius");
    sphere.radius = -sphere.radius;
    sphere.inward = !sphere.inward;
  }
  if (!(sphere.radius > 0)) a.fail("zero radius");
  return sphere;
}

std::optional<Shape> readCone(const PrimitiveArguments& a, const Warn& warn) {
  const bool cylinder = a.type() == Type::cylinder || a.type() == Type::tube;
  a.needReals(cylinder ? 7 : 8);
  needTraceable(a);
  const auto r = a.reals();
  const bool inward = a.type() == Type::cup || a.type() == Type::tube;
  Cone cone{a.vector(0), a.vector(3) - a.vector(0), 0, r[6], r.back(), inward};
  if (cone.radius0 < 0 || cone.radius1 < 0) {
    if (cone.radius0 > 0 || cone.radius1 > 0) return leftOut(a, warn, "illegal radii");
    a.warn(warn, cylinder ? "negative radius" : "negative radii");
    cone.radius0 = -cone.radius0;
    cone.radius1 = -cone.radius1;
    cone.inward = !cone.inward;
  }
  if (!(cone.radius0 > 0 || cone.radius1 > 0)) return leftOut(a, warn, "illegal radii");
  cone.length = cone.axis.length();
  if (!(cone.length > 0)) return leftOut(a, warn, "unknown orientation");
  cone.axis /= cone.length;
  return cone;
}

std::optional<Shape> readRing(const PrimitiveArguments& a, const Warn& warn) {
  a.needReals(8);
  needTraceable(a);
  const auto r = a.reals();
  const double length = a.vector(3).length();
  if (r[6] < 0 || r[7] < 0 || r[6] == r[7]) return leftOut(a, warn, "illegal radii");
  if (!(length > 0)) return leftOut(a, warn, "unknown orientation");
  return Ring{a.vector(0), a.vector(3) / length, std::min(r[6], r[7]), std::max(r[6], r[7])};
}

std::optional<Shape> readSource(const PrimitiveArguments& a) {
  a.needReals(4);
  const V3d direction = a.vector(0);
  const double length = direction.length();
  if (!(length > 0)) a.fail("zero direction");
  if (!(a.reals()[3] > 0)) a.fail("zero size");
  const double half = std::min(radians(a.reals()[3]) / 2, std::numbers::pi);
  return Distant{direction / length, half, std::cos(half), coneSolidAngle(2 * half * 180 / std::numbers::pi)};
}

PlacedFile readPlacedFile(const PrimitiveArguments& a) {
  if (a.strings() == 0) a.fail("expected a file name");
  PlacedFile made{std::string(a.string(0)), readPlacement(a, a.stringsFrom(1))};
  for (const rad::Similarity& s : {made.placement.toOuter, made.placement.toInner}) {
    bool finite = std::isnormal(s.scale);
    for (const auto& row : s.matrix.x)
      for (const double x : row) finite = finite && std::isfinite(x);
    if (!finite) a.fail("the transform exceeds the range of numbers");
  }
  return made;
}

}  // namespace rsphere
