#include "openings/rectangle.h"

namespace rsphere {

std::span<const V3d> cornersOf(const Scene& scene, const Polygon& polygon) {
  return std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices);
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
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (const Polygon* polygon : polygons)
    for (const V3d& corner : cornersOf(scene, *polygon)) {
      const V3d way = corner - first[0];
      const double to[2] = {way.dot(r.x), way.dot(r.y)};
      for (int c = 0; c < 2; ++c) {
        low[c] = std::min(low[c], to[c]);
        high[c] = std::max(high[c], to[c]);
      }
    }
  r.corner = first[0] + low[0] * r.x + low[1] * r.y;
  r.width = high[0] - low[0];
  r.height = high[1] - low[1];
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
