#include "silhouettes/placed_shape.h"

#include <algorithm>
#include <cmath>

#include "base/overloaded.h"

namespace rsphere {
namespace {

Box3d boxAround(const Sphere& ball) { return ball.radius > 0 ? bounds(ball) : Box3d(); }

Sphere ballAround(const Box3d& box) {
  if (box.isEmpty()) return {V3d(0, 0, 0), 0, false};
  // The second term allows for rounding of the corners, which is an ulp of their coordinates.
  const double reach = box.min.length() + box.max.length();
  return {box.center(), box.size().length() / 2 + 1e-15 * reach, false};
}

SurfacePoint pointOnTriangle(const rad::Mesh& mesh, Random& random) {
  if (mesh.triangles.empty()) return {};
  const auto i = static_cast<size_t>(random.uniform() * static_cast<double>(mesh.triangles.size()));
  const auto& v = mesh.triangles[i].vertices;
  const V3d a = mesh.position(v[0]), ab = mesh.position(v[1]) - a, ac = mesh.position(v[2]) - a;
  const double root = std::sqrt(random.uniform()), t = random.uniform();
  const V3d normal = ab.cross(ac);
  const double area = normal.length() / 2;
  if (!(area > 0)) return {};
  return {a + root * (1 - t) * ab + root * t * ac, normal / (2 * area), std::sqrt(area) * 1e-3};
}

SurfacePoint placed(const SurfacePoint& inner, const Placement& placement) {
  return {placement.toOuter.point(inner.point), placement.directionToOuter(inner.normal),
          inner.clearance * placement.toOuter.scale};
}

Ring placed(const Ring& ring, const Placement& placement) {
  const double scale = placement.toOuter.scale;
  return {placement.toOuter.point(ring.center), placement.directionToOuter(ring.normal), ring.inner * scale,
          ring.outer * scale};
}

Cone placed(const Cone& cone, const Placement& placement) {
  const double scale = placement.toOuter.scale;
  return {placement.toOuter.point(cone.base),
          placement.directionToOuter(cone.axis),
          cone.length * scale,
          cone.radius0 * scale,
          cone.radius1 * scale,
          cone.inward};
}

PlacedShape placed(const Polygon& polygon, std::span<const V3d> vertices, const Placement& placement) {
  PlacedShape result;
  for (const V3d& v : vertices.subspan(polygon.firstVertex, polygon.vertices))
    result.vertices.push_back(placement.toOuter.point(v));
  // A mirror image reverses the orientation.
  if (placement.toOuter.matrix.determinant() < 0)
    std::reverse(result.vertices.begin(), result.vertices.end());
  result.shape = makePolygon(result.vertices, 0, polygon.vertices);
  return result;
}

}  // namespace

Sphere placed(const Sphere& ball, const Placement& placement) {
  return {placement.toOuter.point(ball.center), ball.radius * placement.toOuter.scale, ball.inward};
}

PlacedShape placed(ShapeRef shape, std::span<const V3d> vertices, const Placement& placement) {
  return match(
      shape, [&](const Polygon& polygon) { return placed(polygon, vertices, placement); },
      [&](const OneOf<Sphere, Cone, Ring> auto& form) {
        return PlacedShape{placed(form, placement), {}};
      },
      [](const Distant&) { return PlacedShape{}; }, [](const NestedShape auto&) { return PlacedShape{}; });
}

SurfacePoint samplePoint(const Scene& scene, const Surface& surface, Random& random) {
  return match(
      surface.shape,
      [&](const MeshInstance& mesh) {
        return placed(pointOnTriangle(scene.meshes[mesh.mesh].data, random),
                      scene.placements[mesh.placement]);
      },
      [&](const Instance& instance) {
        const SurfaceGroup& group = scene.groups[instance.group];
        const size_t count = group.surfaces.size();
        if (count == 0) return SurfacePoint{};
        const auto i = static_cast<size_t>(random.uniform() * static_cast<double>(count));
        return placed(samplePoint(scene, scene.surfaces[group.surfaces[i]], random),
                      scene.placements[instance.placement]);
      },
      [&](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) {
        return samplePoint(surface.shape, scene.vertices, random);
      });
}

Sphere BoundingBalls::ofGroup(uint32_t index) {
  const auto known = groups_.find(index);
  if (known != groups_.end()) return known->second;
  const SurfaceGroup& group = scene_.groups[index];
  Box3d box;
  for (const SurfaceId i : group.surfaces) box.extendBy(boxOf(scene_.surfaces[i]));
  return groups_[index] = ballAround(box);
}

Box3d BoundingBalls::boxOf(const Surface& surface) {
  return match(
      surface.shape,
      [&](const Instance& instance) {
        return boxAround(placed(ofGroup(instance.group), scene_.placements[instance.placement]));
      },
      [&](const MeshInstance& mesh) {
        return boxAround(placed(ofMesh(mesh.mesh), scene_.placements[mesh.placement]));
      },
      [&](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) {
        return bounds(surface.shape, scene_.vertices);
      });
}

const BoundingBalls::MeshBalls& BoundingBalls::meshBalls(uint32_t index) {
  const auto known = meshes_.find(index);
  if (known != meshes_.end()) return known->second;
  const rad::Mesh& mesh = scene_.meshes[index].data;
  Box3d all;
  std::vector<Box3d> byMaterial(scene_.meshes[index].facesOf.size());
  for (const rad::Mesh::Triangle& t : mesh.triangles)
    for (const uint32_t v : t.vertices) {
      const V3d at = mesh.position(v);
      all.extendBy(at);
      if (t.material != rad::Mesh::kNoMaterial) byMaterial[static_cast<size_t>(t.material)].extendBy(at);
    }
  MeshBalls balls{ballAround(all), {}};
  for (const Box3d& box : byMaterial) balls.byMaterial.push_back(ballAround(box));
  return meshes_[index] = std::move(balls);
}

}  // namespace rsphere
