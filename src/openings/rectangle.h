#pragma once
// Bounding rectangles of coplanar polygons.
#include <array>
#include <span>

#include "base/constants.h"
#include "scene/scene.h"

namespace rsphere {

// Lengths in world units.
struct Rectangle {
  V3d corner{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, normal{0, 0, 1};  // x, y, normal: unit, orthogonal
  double width = 0, height = 0;                                  // along x and y

  double area() const { return width * height; }
  // The point at these fractions of the width and the height.
  V3d at(double u, double v) const { return corner + u * width * x + v * height * y; }
  std::array<V3d, 4> corners() const { return {at(0, 0), at(1, 0), at(1, 1), at(0, 1)}; }
  // The height of a point above the plane of the rectangle, on the side of the normal.
  double above(const V3d& point) const { return (point - corner).dot(normal); }
};

// Whether a point of the rectangle's plane lies in the rectangle.
inline bool contains(const Rectangle& r, const V3d& at) {
  const V3d from = at - r.corner;
  const double u = from.dot(r.x), v = from.dot(r.y);
  return u >= 0 && v >= 0 && u <= r.width && v <= r.height;
}

// The box around places that are projected onto the rectangle's plane, along its x and y, from its corner.
Imath::Box2d extentIn(const Rectangle& r, std::span<const V3d> places);

// The form factor to the front of the rectangle from a place with this normal (unit), estimated from five of
// its points. filled: area of the parts that send light (square world units). counts(at): whether a point
// sends light.
template <class Counts>
double formFactorTo(const Rectangle& r, double filled, const V3d& point, const V3d& normal, Counts counts) {
  if (!(r.above(point) > 0)) return 0;
  // The middle and four other points, which are separated by sqrt(5/12) of the sides, so that the mean of the
  // five is exact for polynomials of the third degree.
  constexpr double kBetween = .6454972243679028, kInset = (1 - kBetween) / 2;
  double factor = 0;
  for (int c = 0; c < 5; ++c) {
    const double a = c < 4 ? kInset + kBetween * (c & 1) : .5;
    const double b = c < 4 ? kInset + kBetween * (c >> 1) : .5;
    const V3d at = r.at(a, b), way = at - point;
    const double squared = way.length2();
    const double here = way.dot(normal), there = -way.dot(r.normal);
    if (here > 0 && there > 0 && counts(at)) factor += here * there / (squared * squared);
  }
  return factor / 5 * filled / kPi;
}

// The distance at which a ray (direction: unit) meets the front of the rectangle; kFarAway if it does not
// within `farthest`.
double distanceTo(const Rectangle& r, const V3d& origin, const V3d& direction, double farthest = kFarAway);

// The density per sr, in a direction from a point, of the directions to uniformly distributed points on the
// rectangle's front.
double densityTo(const Rectangle& r, const V3d& point, const V3d& direction);

// The smallest rectangle around coplanar polygons that is aligned with the longest edge of the first polygon.
// Edges whose lengths differ only by rounding are treated as equal, and the first is used. The normal is the
// first polygon's. REQUIRES at least one polygon. The area may be 0 if a polygon has no area.
Rectangle rectangleAround(const Scene& scene, std::span<const Polygon* const> polygons);

// The vertices of a polygon of the scene (world units).
std::span<const V3d> cornersOf(const Scene& scene, const Polygon& polygon);

}  // namespace rsphere
