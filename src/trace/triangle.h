#pragma once
// Triangles of a mesh, in the mesh's coordinates.
#include <cstdint>

#include "rad_parser/binary/mesh_file.h"
#include "scene/shape.h"

namespace rsphere {

struct TriangleHit {
  ShapeHit hit;
  double weight1, weight2;  // barycentric, for vertices 1 and 2 of the triangle
};

// Like intersect() in shape.h. A ray within rounding of an edge (1e-15 of the distance) hits the triangle, so
// that no light leaks between adjacent triangles.
bool intersect(const rad::Mesh& mesh, uint32_t triangle, const V3d& origin, const V3d& direction,
               double farthest, TriangleHit& hit, double nearest = kSamePlace);

Box3d bounds(const rad::Mesh& mesh, uint32_t triangle);

// Interpolated values of the vertices at a hit: the unit normal, and the local coordinates (u, v). Each is 0
// if a vertex has no such value.
V3d smoothNormal(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit);
Imath::V2d localCoordinates(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit);

}  // namespace rsphere
