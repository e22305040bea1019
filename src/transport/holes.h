#pragma once
// Holes in walls, floors and roofs: doorways, windows without panes, courtyards. A wall is made of the polygons that
// lie in one plane; a hole is a part of the rectangle around them, or of its edge, that none of them covers.
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// A rectangle in a plane. x, y, normal: unit; lengths in world units.
struct Rectangle {
  V3d corner{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, normal{0, 0, 1};
  double width = 0, height = 0;
};

// The holes of at least this area (square world units), the largest first, to within a cell of a grid over each wall
// (tuning::Holes::kCells). Only those that fill most of the rectangle around them, and only in the largest walls.
std::vector<Rectangle> holesOf(const Scene& scene, double leastArea);

}  // namespace rsphere
