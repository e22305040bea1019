#pragma once
// Holes in walls, floors and roofs, such as doorways and windows without panes. A wall consists of all
// polygons in a plane. A hole is a part of their bounding rectangle that no polygon covers. Coverage is
// determined on a grid over the wall: a cell is covered if a polygon contains its middle.
#include <vector>

#include "scene/scene.h"
#include "transport/function_ref.h"
#include "transport/rectangle.h"

namespace rsphere {

// Whether a surface can be part of a wall.
using IsWall = FunctionRef<bool(const Surface&)>;

// The bounding rectangles of holes of at least this area (square world units), the largest first. Their edges
// are moved to corners of the wall's polygons that are less than a cell away (tuning::Holes::kCells).
// Ignored: holes covering little of their bounding rectangle or open on most sides, polygons below the given
// area, all but the largest walls, and the contents of instances. bounds: of the scene.
std::vector<Rectangle> holesOf(const Scene& scene, const Box3d& bounds, double leastArea, IsWall isWall);

}  // namespace rsphere
