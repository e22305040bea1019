#pragma once
// Bounding rectangles of coplanar polygons.
#include <span>

#include "scene/scene.h"

namespace rsphere {

// Lengths in world units.
struct Rectangle {
  V3d corner{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, normal{0, 0, 1};  // x, y, normal: unit, orthogonal
  double width = 0, height = 0;                                  // along x and y

  double area() const { return width * height; }
  // The point at these fractions of the width and the height.
  V3d at(double u, double v) const { return corner + u * width * x + v * height * y; }
};

// The smallest rectangle around coplanar polygons that is aligned with the longest edge of the first polygon.
// Edges whose lengths differ only by rounding are treated as equal, and the first is used. The normal is that
// of the first polygon. REQUIRES at least one polygon. The area may be 0 if a polygon has no area.
Rectangle rectangleAround(const Scene& scene, std::span<const Polygon* const> polygons);

// The vertices of a polygon of the scene (world units).
std::span<const V3d> cornersOf(const Scene& scene, const Polygon& polygon);

}  // namespace rsphere
