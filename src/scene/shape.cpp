#include "scene/shape.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/constants.h"

namespace rsphere {
namespace {

// The rounding error of a coordinate difference, relative to the coordinates: two ulp.
constexpr double kRounding = 4.5e-16;

// The normal, scaled by twice the area. It is computed relative to the first vertex, so that it is accurate
// far from the origin.
V3d normalByTwiceTheArea(std::span<const V3d> vertices) {
  V3d sum(0, 0, 0);
  for (size_t i = 2; i < vertices.size(); ++i)
    sum += (vertices[i - 1] - vertices[0]).cross(vertices[i] - vertices[0]);
  return sum;
}

// The sum of the vertices' signed distances from the plane through the first one.
double offsetsFromFirst(const V3d& normal, std::span<const V3d> vertices) {
  double offsets = 0;
  for (const V3d& v : vertices) offsets += normal.dot(v - vertices[0]);
  return offsets;
}

std::span<const V3d> verticesOf(const Polygon& polygon, std::span<const V3d> all) {
  return all.subspan(polygon.firstVertex, polygon.vertices);
}

double largestCoordinate(const Box3d& box) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(box.min[i]), std::abs(box.max[i])});
  return largest;
}

// Threshold of the cross product below which a point is treated as lying on an edge. size: of the coordinates
// from which the product is computed.
double onEdge(double tolerance, double size) { return (tolerance + kRounding * size) * size; }

// inside() for a point that may lie on an edge or on its extension.
bool insideClosely(std::span<const V3d> vertices, int xi, int yi, double x, double y, double tolerance) {
  bool odd = false;
  const V3d* from = &vertices.back();
  for (const V3d& to : vertices) {
    const double y0 = (*from)[yi] - y, y1 = to[yi] - y;
    const double x0 = (*from)[xi] - x, x1 = to[xi] - x;
    from = &to;
    const bool crosses = (y0 > 0) != (y1 > 0);
    if (!crosses && std::min(std::abs(y0), std::abs(y1)) > tolerance) continue;
    if (std::min(x0, x1) > tolerance) {
      odd ^= crosses;
      continue;
    }
    if (std::max(x0, x1) < -tolerance) continue;
    // The point is in the bounding box of the edge. It is either on the edge or clearly on one side of it.
    const double cross = x0 * y1 - x1 * y0;
    const double size = std::abs(x0) + std::abs(x1) + std::abs(y0) + std::abs(y1);
    if (std::abs(cross) <= onEdge(tolerance, size)) return true;
    odd ^= crosses && (cross > 0) == (y1 > y0);
  }
  return odd;
}

// Half the size of the bounding box of a disk with radius 1 and this normal.
V3d diskExtent(const V3d& normal) {
  V3d extent;
  for (int i = 0; i < 3; ++i) extent[i] = std::sqrt(std::max(0., 1 - normal[i] * normal[i]));
  return extent;
}

}  // namespace

double samePlaceIn(const Box3d& box) {
  if (box.isEmpty()) return kSamePlace;
  // Scenes whose largest side is above kSmall (world units) have RADIANCE's value. In metres these include
  // lamps without a room, whose light is measured from afar.
  constexpr double kSmall = .01, kShare = 1e-5;
  const V3d size = box.size();
  const double largest = std::max({size.x, size.y, size.z});
  return std::max(largest < kSmall ? kShare * largest : kSamePlace, 4 * kRounding * largestCoordinate(box));
}

double roundingIn(const Box3d& box) {
  // At an angle of 1e-3 to a plane, an error of its distance is a thousand times as large along the ray.
  return box.isEmpty() ? 0 : std::min(samePlaceIn(box), 1e3 * kRounding * largestCoordinate(box));
}

Polygon makePolygon(std::span<const V3d> all, uint32_t first, uint32_t count) {
  Polygon polygon;
  polygon.firstVertex = first;
  polygon.vertices = count;
  const auto vertices = verticesOf(polygon, all);
  const V3d sum = normalByTwiceTheArea(vertices);
  const double length = sum.length();
  if (!(length > 0)) return polygon;
  polygon.normal = sum / length;
  polygon.offset = polygon.normal.dot(vertices[0]) + offsetsFromFirst(polygon.normal, vertices) / count;
  const V3d n(std::abs(polygon.normal.x), std::abs(polygon.normal.y), std::abs(polygon.normal.z));
  polygon.axis = n.y > n.x ? 1 : 0;
  if (n.z > n[polygon.axis]) polygon.axis = 2;
  polygon.hasArea = 1;
  Box3d box;
  for (const V3d& v : vertices) box.extendBy(v);
  // Rounded up by more than the rounding errors of the sum and of single precision (2^-24).
  polygon.extent = static_cast<float>(
      (box.size().x + box.size().y + box.size().z - box.size()[polygon.axis]) * (1 + 1e-6));
  return polygon;
}

double areaOf(const Polygon& polygon, std::span<const V3d> all) {
  return polygon.hasArea ? normalByTwiceTheArea(verticesOf(polygon, all)).length() / 2 : 0;
}

double thicknessOf(const Polygon& polygon, std::span<const V3d> all) {
  if (!polygon.hasArea) return 0;
  const auto vertices = verticesOf(polygon, all);
  const double mean = offsetsFromFirst(polygon.normal, vertices) / static_cast<uint32_t>(vertices.size());
  double thickness = 0;
  for (const V3d& v : vertices)
    thickness = std::max(thickness, std::abs(polygon.normal.dot(v - vertices[0]) - mean));
  return thickness;
}

// Contains no branches that depend on the position of the point, because half of them would be mispredicted.
bool inside(const Polygon& polygon, std::span<const V3d> all, const V3d& point, double tolerance) {
  const int xi = polygon.axis == 2 ? 0 : polygon.axis + 1;
  const int yi = xi == 2 ? 0 : xi + 1;
  const double x = point[xi], y = point[yi];
  const auto vertices = all.subspan(polygon.firstVertex, polygon.vertices);
  // An upper bound for all edges whose bounding box contains the point.
  const double near = onEdge(tolerance, polygon.extent + 4 * tolerance);
  // The sign bit. Differences are point minus vertex, so that equal coordinates have a positive sign.
  const auto sign = [](double v) { return std::bit_cast<uint64_t>(v); };
  uint64_t odd = 0;
  double nearest = std::numeric_limits<double>::infinity();
  double x0 = x - vertices.back()[xi], y0 = y - vertices.back()[yi];
  for (const V3d& to : vertices) {
    const double x1 = x - to[xi], y1 = y - to[yi];
    const double cross = x1 * y0 - x0 * y1;
    nearest = std::min(nearest, std::abs(cross));
    odd ^= (sign(y0) ^ sign(y1)) & ~(sign(cross) ^ sign(y1));
    x0 = x1;
    y0 = y1;
  }
  return nearest <= near ? insideClosely(vertices, xi, yi, x, y, tolerance) : odd >> 63 != 0;
}

bool meetsInside(const Polygon& polygon, std::span<const V3d> vertices, const V3d& origin,
                 const V3d& direction, double distance, double cosine) {
  if (!polygon.hasArea) return false;
  // Two polygons that share an edge compute hits of one ray that differ by this distance, because each rounds
  // the distance along the ray separately. Points this close to the edge are inside both, so that no light
  // leaks between them.
  const double size = std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z) + distance;
  const double tolerance = 2 * kRounding * size / std::abs(cosine);
  return inside(polygon, vertices, origin + distance * direction, tolerance);
}

bool intersect(const Sphere& sphere, const V3d& origin, const V3d& direction, double farthest, ShapeHit& hit,
               double nearest) {
  const V3d m = origin - sphere.center;
  const double b = m.dot(direction);
  // Computed from the distance between line and centre, because b^2 - c loses all accuracy for a small sphere
  // far away.
  const V3d closest = m - b * direction;
  const double discriminant = sphere.radius * sphere.radius - closest.length2();
  if (!(discriminant >= 0)) return false;
  const double half = std::sqrt(discriminant);
  double t = -b - half;
  if (t <= nearest) t = -b + half;
  if (!(t > nearest && t <= farthest)) return false;
  const V3d outward = (m + t * direction).normalized();
  hit.distance = t;
  hit.normal = sphere.inward ? -outward : outward;
  hit.cosine = -hit.normal.dot(direction);
  return true;
}

bool intersect(const Cone& cone, const V3d& origin, const V3d& direction, double farthest, ShapeHit& hit,
               double nearest) {
  const V3d m = origin - cone.base;
  // Early exit for most rays: their line passes the axis at a greater distance than the larger radius.
  const V3d across = direction.cross(cone.axis);
  const double widest = std::max(cone.radius0, cone.radius1), off = m.dot(across);
  if (off * off > 1.000001 * widest * widest * across.length2() + 1e-12 * m.length2()) return false;
  const double mAxis = m.dot(cone.axis), dAxis = direction.dot(cone.axis);
  V3d mAcross = m - mAxis * cone.axis;
  const V3d dAcross = direction - dAxis * cone.axis;
  const double slope = (cone.radius1 - cone.radius0) / cone.length;
  // |mAcross + t dAcross| = radius0 + slope (mAxis + t dAxis), squared: a t^2 + 2 b t + c = 0
  const double a = dAcross.length2() - slope * slope * dAxis * dAxis;
  const double radiusAtOrigin = cone.radius0 + slope * mAxis;
  double roots[2];
  int count = 0;
  if (slope == 0) {
    if (a <= kRounding) return false;
    const double b = mAcross.dot(dAcross) / a;
    const double discriminant = cone.radius0 * cone.radius0 - (mAcross - b * dAcross).length2();
    if (!(discriminant >= 0)) return false;
    const double half = std::sqrt(discriminant / a);
    roots[count++] = -b - half;
    roots[count++] = -b + half;
  } else {
    const double b = mAcross.dot(dAcross) - slope * dAxis * radiusAtOrigin;
    const double c = mAcross.length2() - radiusAtOrigin * radiusAtOrigin;
    if (std::abs(a) <= kRounding) {
      if (b == 0) return false;
      roots[count++] = -c / (2 * b);
    } else {
      const double discriminant = b * b - a * c;
      if (!(discriminant >= 0)) return false;
      const double q = -(b + std::copysign(std::sqrt(discriminant), b));
      roots[count++] = q / a;
      if (q != 0) roots[count++] = c / q;
      if (count == 2 && roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    }
  }
  for (int i = 0; i < count; ++i) {
    const double t = roots[i];
    if (!(t > nearest && t <= farthest)) continue;
    const double along = mAxis + t * dAxis;
    if (along < 0 || along > cone.length) continue;
    const V3d radial = mAcross + t * dAcross;
    const double distance = radial.length();
    if (!(distance > 0)) continue;  // the tip has no normal
    V3d outward = radial / distance - slope * cone.axis;
    outward /= std::sqrt(1 + slope * slope);
    hit.distance = t;
    hit.normal = cone.inward ? -outward : outward;
    hit.cosine = -hit.normal.dot(direction);
    return true;
  }
  return false;
}

bool intersect(const Ring& ring, const V3d& origin, const V3d& direction, double farthest, ShapeHit& hit,
               double nearest) {
  const double cosine = -ring.normal.dot(direction);
  if (std::abs(cosine) <= kSamePlace) return false;
  const V3d m = origin - ring.center;
  const double t = ring.normal.dot(m) / cosine;
  if (!(t > nearest && t <= farthest)) return false;
  const double r2 = (m + t * direction).length2();
  if (r2 > ring.outer * ring.outer || r2 < ring.inner * ring.inner) return false;
  hit = {t, ring.normal, cosine};
  return true;
}

Box3d bounds(const Polygon& polygon, std::span<const V3d> vertices) {
  Box3d box;
  for (const V3d& v : vertices.subspan(polygon.firstVertex, polygon.vertices)) box.extendBy(v);
  if (polygon.hasArea) {
    // Hits lie on the mean plane. If the vertices are not coplanar, the plane extends beyond their box along
    // the projection axis.
    const double out = thicknessOf(polygon, vertices) / std::abs(polygon.normal[polygon.axis]);
    box.min[polygon.axis] -= out;
    box.max[polygon.axis] += out;
  }
  return box;
}

Box3d bounds(const Sphere& sphere) {
  const V3d r(sphere.radius);
  return Box3d(sphere.center - r, sphere.center + r);
}

Box3d bounds(const Cone& cone) {
  const V3d extent = diskExtent(cone.axis);
  const V3d end = cone.base + cone.length * cone.axis;
  Box3d box(cone.base - cone.radius0 * extent, cone.base + cone.radius0 * extent);
  box.extendBy(end - cone.radius1 * extent);
  box.extendBy(end + cone.radius1 * extent);
  return box;
}

Box3d bounds(const Ring& ring) {
  const V3d extent = ring.outer * diskExtent(ring.normal);
  return Box3d(ring.center - extent, ring.center + extent);
}

bool intersect(ShapeRef shape, std::span<const V3d> vertices, const V3d& origin, const V3d& direction,
               double farthest, ShapeHit& hit, double nearest) {
  return match(
      shape,
      [&](const Polygon& polygon) {
        return intersect(polygon, vertices, origin, direction, farthest, hit, nearest);
      },
      [&](const OneOf<Sphere, Cone, Ring> auto& form) {
        return intersect(form, origin, direction, farthest, hit, nearest);
      },
      [](const Distant&) { return false; }, [](const NestedShape auto&) { return false; });
}

Box3d bounds(ShapeRef shape, std::span<const V3d> vertices) {
  return match(
      shape, [&](const Polygon& polygon) { return bounds(polygon, vertices); },
      [](const OneOf<Sphere, Cone, Ring> auto& form) { return bounds(form); },
      [](const Distant&) { return Box3d(); }, [](const NestedShape auto&) { return Box3d(); });
}

double planeOffset(ShapeRef shape) {
  return match(
      shape, [](const Polygon& polygon) { return polygon.offset; },
      [](const Ring& ring) { return ring.normal.dot(ring.center); },
      [](const OneOf<Sphere, Cone, Distant> auto&) { return 0.; },
      [](const NestedShape auto&) { return 0.; });
}

bool isClosed(ShapeRef shape) {
  return match(
      shape, [](const Sphere&) { return true; },
      [](const OneOf<Polygon, Cone, Ring, Distant> auto&) { return false; },
      [](const NestedShape auto&) { return false; });
}

double areaOf(ShapeRef shape, std::span<const V3d> vertices) {
  return match(
      shape, [&](const Polygon& p) { return areaOf(p, vertices); },
      [](const Sphere& s) { return 4 * kPi * s.radius * s.radius; },
      [](const Cone& c) { return kPi * (c.radius0 + c.radius1) * c.length; },
      [](const Ring& r) { return kPi * (r.outer * r.outer - r.inner * r.inner); },
      [](const Distant&) { return 0.; }, [](const NestedShape auto&) { return 0.; });
}

V3d centerOf(const Polygon& polygon, std::span<const V3d> all) {
  const auto vertices = all.subspan(polygon.firstVertex, polygon.vertices);
  V3d center(0, 0, 0);
  for (const V3d& v : vertices) center += v / static_cast<double>(vertices.size());
  return center;
}

}  // namespace rsphere
