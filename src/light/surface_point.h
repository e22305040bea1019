#pragma once
#include <span>

#include "scene/random.h"
#include "scene/shape.h"

namespace rsphere {

// A point on a shape and its unit normal on the front side. clearance: the distance (world units) from the
// point at which a ray back to it may start, so that it hits nothing else.
struct SurfacePoint {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};
  double clearance = 0;
};

// A random point, uniform by area on spheres, cylinders, rings and convex polygons. On cones it is uniform
// along the axis instead. For a concave polygon it may lie outside the polygon. REQUIRES that the shape is
// not Distant. vertices: Scene::vertices.
SurfacePoint samplePoint(ShapeRef shape, std::span<const V3d> vertices, Random& random);

}  // namespace rsphere
