#pragma once
// The contents of instances and meshes in world coordinates, for silhouettes and for points on surfaces.
#include <map>
#include <vector>

#include "light/surface_point.h"
#include "scene/scene.h"

namespace rsphere {

// A shape other than an instance or mesh, with its vertices if it is a polygon.
struct PlacedShape {
  Shape shape;
  std::vector<V3d> vertices;
};

// Converts a shape of an octree to world coordinates; exact to rounding.
PlacedShape placed(ShapeRef shape, std::span<const V3d> vertices, const Placement& placement);

// A random point of a surface, in world coordinates. In an instance every surface is equally probable, in a
// mesh every triangle; other shapes use their own samplePoint(). clearance is 0 if there is no point.
SurfacePoint samplePoint(const Scene& scene, const Surface& surface, Random& random);

// Balls around the contents of instances and meshes, in the coordinates of the octree or mesh. Each is
// computed at its first use. Keeps a reference to the scene.
class BoundingBalls {
 public:
  explicit BoundingBalls(const Scene& scene) : scene_(scene) {}

  // Around everything in a group or a mesh. The radius is 0 if it is empty.
  Sphere ofGroup(uint32_t group);
  Sphere ofMesh(uint32_t mesh) { return meshBalls(mesh).all; }
  // Around the triangles of one material of the mesh.
  Sphere ofFaces(uint32_t mesh, size_t material) { return meshBalls(mesh).byMaterial[material]; }

 private:
  struct MeshBalls {
    Sphere all;
    std::vector<Sphere> byMaterial;
  };
  const MeshBalls& meshBalls(uint32_t mesh);
  Box3d boxOf(const Surface& surface);

  const Scene& scene_;
  std::map<uint32_t, Sphere> groups_;
  std::map<uint32_t, MeshBalls> meshes_;
};

// Converts a ball to the coordinates in which it is placed.
Sphere placed(const Sphere& ball, const Placement& placement);

}  // namespace rsphere
