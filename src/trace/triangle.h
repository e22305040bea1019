#pragma once
// Triangles of a mesh, in the mesh's coordinates.
#include <cstdint>

#include "rad_parser/mesh_file.h"
#include "scene/shape.h"

namespace rsphere {

struct TriangleHit {
  ShapeHit hit;
  double weight1, weight2;  // barycentric, of the triangle's vertices 1 and 2
};

// As the intersect() of shape.h. Rays within rounding (1e-15 of the distance) of an edge count as inside, so
// that no light leaks between triangles that share one.
bool intersect(const rad::Mesh& mesh, uint32_t triangle, const V3d& origin, const V3d& direction,
               double farthest, TriangleHit& hit);

Box3d bounds(const rad::Mesh& mesh, uint32_t triangle);

// What interpolation makes of the vertices' values at a hit: the unit normal, (0, 0, 0) where a vertex has
// none; (u,v), (0, 0) likewise.
V3d smoothNormal(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit);
Imath::V2d localCoordinates(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit);

}  // namespace rsphere
