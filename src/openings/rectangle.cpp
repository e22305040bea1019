#include "openings/rectangle.h"

namespace rsphere {

std::span<const V3d> cornersOf(const Scene& scene, const Polygon& polygon) {
  return std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices);
}

Imath::Box2d extentIn(const Rectangle& r, std::span<const V3d> places) {
  Imath::Box2d around;
  for (const V3d& place : places) {
    const V3d way = place - r.corner;
    around.extendBy({way.dot(r.x), way.dot(r.y)});
  }
  return around;
}

Rectangle rectangleAround(const Scene& scene, std::span<const Polygon* const> polygons) {
  const std::span<const V3d> first = cornersOf(scene, *polygons.front());
  Rectangle r;
  r.normal = polygons.front()->normal;
  double longest = 0;
  for (size_t i = 0; i < first.size(); ++i) {
    const V3d edge = first[(i + 1) % first.size()] - first[i];
    if (edge.length2() <= longest * (1 + 1e-9)) continue;
    longest = edge.length2();
    r.x = edge;
  }
  r.x = (r.x - r.x.dot(r.normal) * r.normal).normalized();
  r.y = r.normal.cross(r.x);
  r.corner = first[0];
  Imath::Box2d around;
  for (const Polygon* polygon : polygons) around.extendBy(extentIn(r, cornersOf(scene, *polygon)));
  r.corner += around.min.x * r.x + around.min.y * r.y;
  r.width = around.size().x;
  r.height = around.size().y;
  return r;
}

double distanceTo(const Rectangle& r, const V3d& origin, const V3d& direction, double farthest) {
  const double cosine = -direction.dot(r.normal);
  if (!(cosine > 0)) return kFarAway;
  const double distance = r.above(origin) / cosine;
  const bool meets = distance >= 0 && distance < farthest && contains(r, origin + distance * direction);
  return meets ? distance : kFarAway;
}

double densityTo(const Rectangle& r, const V3d& point, const V3d& direction) {
  const double distance = distanceTo(r, point, direction);
  return distance < kFarAway ? distance * distance / (-direction.dot(r.normal) * r.area()) : 0;
}

}  // namespace rsphere
