#pragma once
// Bounding rectangles of coplanar polygons.
#include <algorithm>
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

// The projected area (square world units) of openings for light that enters in this direction (unit). Their
// normals point to the dark side.
template <class Opening>
double areaTowards(std::span<const Opening> openings, const V3d& direction) {
  double sum = 0;
  for (const Opening& o : openings) sum += std::max(0., direction.dot(o.normal)) * o.area();
  return sum;
}

// A point on them, uniform by projected area; u1, u2, u3: uniform in [0, 1). REQUIRES that this area is above
// 0.
template <class Opening>
V3d pointTowards(std::span<const Opening> openings, const V3d& direction, double u1, double u2, double u3) {
  double due = u1 * areaTowards(openings, direction);
  const Opening* chosen = nullptr;
  for (const Opening& o : openings) {
    const double area = std::max(0., direction.dot(o.normal)) * o.area();
    if (area > 0) chosen = &o;
    if (due < area) break;
    due -= area;
  }
  return chosen->at(u2, u3);
}

// The smallest rectangle around coplanar polygons that is aligned with the longest edge of the first polygon.
// Edges whose lengths differ only by rounding are treated as equal, and the first is used. The normal is that
// of the first polygon. REQUIRES at least one polygon. The area may be 0 if a polygon has no area.
Rectangle rectangleAround(const Scene& scene, std::span<const Polygon* const> polygons);

// The vertices of a polygon of the scene (world units).
std::span<const V3d> cornersOf(const Scene& scene, const Polygon& polygon);

}  // namespace rsphere
