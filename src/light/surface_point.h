#pragma once
#include <span>

#include "scene/random.h"
#include "scene/shape.h"

namespace rsphere {

// A point on a shape, its unit normal on the front side, and how far from it a ray may start that is to hit
// just it.
struct SurfacePoint {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};
  double clearance = 0;
};

// Even by area for spheres, cylinders, rings and convex polygons; concave polygons may give points beside
// them, cones points that are even along the axis. Not for Distant. vertices: Scene::vertices.
SurfacePoint samplePoint(const Shape& shape, std::span<const V3d> vertices, Random& random);

}  // namespace rsphere
