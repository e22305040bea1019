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

// Like intersect() in shape.h. A ray within rounding of an edge (1e-15 of the distance) hits the triangle, so
// that no light leaks between triangles that share an edge.
bool intersect(const rad::Mesh& mesh, uint32_t triangle, const V3d& origin, const V3d& direction,
               double farthest, TriangleHit& hit);

Box3d bounds(const rad::Mesh& mesh, uint32_t triangle);

// The vertices' values interpolated at a hit: the unit normal, or (0, 0, 0) if a vertex has none; the local
// coordinates (u, v), or (0, 0) if a vertex has none.
V3d smoothNormal(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit);
Imath::V2d localCoordinates(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit);

}  // namespace rsphere
