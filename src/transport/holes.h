#pragma once
// Holes in walls, floors and roofs, such as doorways and windows without panes. A wall is all polygons in one
// plane; a hole is a part of the rectangle around them that no polygon covers. Each wall is divided into
// cells of a grid, which a polygon covers if it contains their middles.
#include <vector>

#include "scene/scene.h"
#include "transport/function_ref.h"
#include "transport/rectangle.h"

namespace rsphere {

// Whether a surface belongs to walls.
using IsWall = FunctionRef<bool(const Surface&)>;

// The rectangles around holes of at least this area (square world units), the largest first. Their edges go
// through corners of the walls' polygons if there are any within a cell (tuning::Holes::kCells). Left out:
// holes covering little of their bounding rectangle or open on most sides, polygons smaller than the given
// area, all but the largest walls, and the contents of instances. bounds: of the scene.
std::vector<Rectangle> holesOf(const Scene& scene, const Box3d& bounds, double leastArea, IsWall isWall);

}  // namespace rsphere
