#pragma once
// Holes in walls, floors and roofs, such as doorways and windows without panes. A wall consists of all
// polygons in a plane. A hole is a part of their bounding rectangle that no polygon covers. Coverage is
// determined on a grid over the wall: a cell is covered if a polygon contains its middle.
#include <vector>

#include "base/function_ref.h"
#include "openings/rectangle.h"
#include "scene/scene.h"

namespace rsphere {

// Whether a surface can be part of a wall.
using IsWall = FunctionRef<bool(const Surface&)>;

// Finds the holes in walls with a grid on each wall (tuning::Holes::kCells), and returns their bounding
// rectangles, the largest first. Edges of the rectangles are moved to corners of the wall's polygons that are
// less than a grid cell away. Holes and polygons below leastArea (square world units) are ignored. So are all
// but the largest walls, the contents of instances, and holes that are open on most sides or cover little of
// their bounding rectangle. bounds: the scene's bounding box.
std::vector<Rectangle> holesOf(const Scene& scene, const Box3d& bounds, double leastArea, IsWall isWall);

}  // namespace rsphere
