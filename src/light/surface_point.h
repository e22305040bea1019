#pragma once
#include <span>

#include "base/random.h"
#include "base/scrambled_sequence.h"
#include "light/light_source.h"

namespace rsphere {

// A point on a shape and its unit normal on the front side. A ray that is aimed at the point from the
// distance `clearance` (world units) hits nothing before it. If it is below a few times Scene::samePlace, the
// tracer treats the shape as the surface on which such a ray starts.
struct SurfacePoint {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};
  double clearance = 0;
};

// A random point, uniform by area on spheres, cylinders, rings and convex polygons, and uniform along the
// axis on cones. For a concave polygon the point may lie outside. REQUIRES that the shape is not Distant.
// vertices: Scene::vertices. Numbers: Random or ScrambledPoint.
template <class Numbers>
SurfacePoint samplePoint(ShapeRef shape, std::span<const V3d> vertices, Numbers& random);

// The same on a real light source, and uniform on concave goals, too.
template <class Numbers>
SurfacePoint samplePoint(const LightSource& source, const Scene& scene, Numbers& random);

// A random direction (unit), uniform over the sphere.
template <class Numbers>
V3d uniformDirection(Numbers& random);

}  // namespace rsphere
