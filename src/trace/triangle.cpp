#include "trace/triangle.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rsphere {
namespace {

double size(const V3d& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// The signed volume spanned by a ray and an edge. Its sign is the side on which the ray passes the edge.
// Values within rounding, a few ulp of the factors, become 0, because two triangles may have the ends of
// their common edge in different order.
double side(const V3d& direction, const V3d& from, const V3d& edge) {
  const double volume = direction.dot(from.cross(edge));
  return std::abs(volume) <= 2e-15 * size(from) * size(edge) ? 0 : volume;
}

template <class Value>
std::optional<Value> interpolated(const std::optional<Value>& a, const std::optional<Value>& b,
                                  const std::optional<Value>& c, const TriangleHit& hit) {
  if (!a || !b || !c) return std::nullopt;
  return *a * (1 - hit.weight1 - hit.weight2) + *b * hit.weight1 + *c * hit.weight2;
}

}  // namespace

// The ray hits if it passes all three edges on the same side (Segura and Feito, WSCG 2001).
bool intersect(const rad::Mesh& mesh, uint32_t triangle, const V3d& origin, const V3d& direction,
               double farthest, TriangleHit& out, double nearest) {
  const auto& corners = mesh.triangles[triangle].vertices;
  const V3d a = mesh.position(corners[0]) - origin, b = mesh.position(corners[1]) - origin,
            c = mesh.position(corners[2]) - origin;
  const V3d ab = b - a, bc = c - b, ca = a - c;
  const double atC = side(direction, a, ab), atA = side(direction, b, bc), atB = side(direction, c, ca);
  if (std::min({atA, atB, atC}) < 0 && std::max({atA, atB, atC}) > 0) return false;
  const V3d normal = ca.cross(ab);
  const double slope = direction.dot(normal);
  if (slope == 0) return false;
  const double t = a.dot(normal) / slope;
  if (!(t > nearest && t <= farthest)) return false;
  const double length = normal.length(), sum = atA + atB + atC;
  if (!(length > 0)) return false;
  out.hit = {t, normal / length, -slope / length};
  out.weight1 = sum == 0 ? 1. / 3 : atB / sum;
  out.weight2 = sum == 0 ? 1. / 3 : atC / sum;
  return true;
}

Box3d bounds(const rad::Mesh& mesh, uint32_t triangle) {
  Box3d box;
  for (uint32_t vertex : mesh.triangles[triangle].vertices) box.extendBy(mesh.position(vertex));
  return box;
}

V3d smoothNormal(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit) {
  const auto& v = mesh.triangles[triangle].vertices;
  return interpolated(mesh.normal(v[0]), mesh.normal(v[1]), mesh.normal(v[2]), hit)
      .value_or(V3d(0, 0, 0))
      .normalized();
}

Imath::V2d localCoordinates(const rad::Mesh& mesh, uint32_t triangle, const TriangleHit& hit) {
  const auto& v = mesh.triangles[triangle].vertices;
  return interpolated(mesh.uv(v[0]), mesh.uv(v[1]), mesh.uv(v[2]), hit).value_or(Imath::V2d(0, 0));
}

}  // namespace rsphere
