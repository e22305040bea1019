#pragma once
// What octrees and meshes bring in, as shapes of the world: for silhouettes and for points to look from.
#include <map>
#include <vector>

#include "light/surface_point.h"
#include "scene/scene.h"

namespace rsphere {

// A plain shape with the vertices that it has if it is a polygon.
struct PlacedShape {
  Shape shape;
  std::vector<V3d> vertices;
};

// A plain shape of an octree as it stands in the world, exact up to rounding.
PlacedShape placed(const Shape& shape, std::span<const V3d> vertices, const Placement& placement);

// A point of a surface in the world: samplePoint()'s for a plain shape; for instances that of any surface in
// them, each as likely, for meshes that of any triangle. clearance is 0 where there is none.
SurfacePoint samplePoint(const Scene& scene, const Surface& surface, Random& random);

// Balls that hold what instances and meshes bring in, in their own coordinates; each is computed once, when
// it is first asked for. Keeps a reference to the scene.
class BoundingBalls {
 public:
  explicit BoundingBalls(const Scene& scene) : scene_(scene) {}

  // Around everything in a group or a mesh; radius 0 where there is nothing.
  Sphere ofGroup(uint32_t group);
  Sphere ofMesh(uint32_t mesh) { return meshBalls(mesh).all; }
  // Around the triangles of one material of the mesh's own.
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

// A ball in the coordinates that hold it.
Sphere placed(const Sphere& ball, const Placement& placement);

}  // namespace rsphere
