#pragma once
// Rectangles around polygons that lie in one plane.
#include <span>

#include "scene/scene.h"

namespace rsphere {

// Lengths in world units.
struct Rectangle {
  V3d corner{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, normal{0, 0, 1};  // x, y, normal: unit, orthogonal
  double width = 0, height = 0;                                  // along x and y

  double area() const { return width * height; }
  // The point at these shares of the width and of the height.
  V3d at(double u, double v) const { return corner + u * width * x + v * height * y; }
};

// The smallest rectangle around coplanar polygons that has a side parallel to the longest edge of the first
// polygon. Among edges of equal length, within rounding, the first is used. Its normal is that of the first
// polygon. REQUIRES a polygon; one of no area may give a rectangle of no area.
Rectangle rectangleAround(const Scene& scene, std::span<const Polygon* const> polygons);

// The vertices of a polygon of the scene (world units).
std::span<const V3d> cornersOf(const Scene& scene, const Polygon& polygon);

}  // namespace rsphere
