#include "transport/blockers.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "scene/shape.h"

namespace rsphere {
namespace {

constexpr size_t kMostKnown = 8;  // number of recent blockers that are kept
// Cap on the surfaces that are examined along the way to a box; furniture or glass may stand in front of a
// wall.
constexpr int kSurfacesInTheWay = 6;

// The smallest distance that boxes must have from the plane of a polygon that hides one box from the other
// (world units). Without it, rays could pass the polygon: a surface nearer than kSamePlace to an end of a ray
// does not block it, and a ray whose cosine to a plane is at most kSamePlace misses the plane.
double marginOver(double length) { return 10 * kSamePlace + 2 * kSamePlace * length; }

std::array<V3d, 8> cornersOf(const Box3d& box) {
  std::array<V3d, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {(i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                  (i & 4 ? box.max : box.min).z};
  return corners;
}

// Calls use() with the surfaces between two points, in the order of a ray, until it returns true. Returns
// whether it has returned true.
bool anySurface(const Tracer& tracer, const V3d& from, const V3d& to, FunctionRef<bool(SurfaceId)> use) {
  V3d way = to - from, origin = from;
  double left = way.length() - kSamePlace;
  if (!(left > 0)) return false;
  way.normalize();
  SurfaceId last = kNone;
  for (int i = 0; i < kSurfacesInTheWay && left > 0; ++i) {
    const Hit hit = tracer.nearest(origin, way, left, last);
    if (hit.surface == kNone) return false;
    if (use(hit.surface)) return true;
    origin += hit.distance * way;
    left -= hit.distance;
    last = hit.surface;
  }
  return false;
}

}  // namespace

int Blocker::axis() const {
  for (int i = 0; i < 3; ++i)
    if (box.max[i] - box.min[i] <= kSamePlace) return i;
  return -1;
}

Blockers::Blockers(const Scene& scene, const Tracer& tracer)
    : scene_(scene), tracer_(tracer), joined_(scene, tracer) {
  if (!tracer.bounds().isEmpty()) margin_ = 2 * marginOver(tracer.bounds().size().length());
}

static_assert(kShapes == 8, "Does a new shape hide what is behind it?");

// Makes an opaque polygon of the scene itself a blocker for rays from a point. Returns false if the surface
// is not such a polygon. withArea: looks up the polygon's area, and also returns false if the polygon is
// concave and belongs to none. Without it, the area is only looked up when it is needed, because most
// polygons can be rejected in less time.
bool Blockers::find(SurfaceId id, const V3d& from, bool withArea, Blocker& blocker) const {
  if (id.index() >= scene_.outermostIds().size()) return false;
  const Surface surface = scene_.surfaces[id];
  const auto* const polygon = surface.shape.as<Polygon>();
  if (!polygon || !polygon->hasArea) return false;
  const double side = polygon->normal.dot(from) - polygon->offset;
  if (!tracer_.stopsShadows(id, side > 0)) return false;
  if (thicknessOf(*polygon, scene_.vertices) > kSamePlace) return false;
  const double sign = side > 0 ? 1 : -1;
  blocker = {.surface = id, .normal = sign * polygon->normal, .offset = sign * polygon->offset};
  blocker.size = polygon->extent / 2;
  blocker.box = rsphere::bounds(*polygon, scene_.vertices);
  const auto corners = std::span(scene_.vertices).subspan(polygon->firstVertex, polygon->vertices);
  // A polygon is convex if all vertices lie on the inner side of all edges and the edges make one full turn.
  const auto isConvex = [&] {
    if (corners.size() > Blocker::kMostVertices) return false;
    double turn = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const V3d& a = corners[i];
      const V3d& b = corners[(i + 1) % corners.size()];
      const V3d& c = corners[(i + 2) % corners.size()];
      const V3d inward = polygon->normal.cross(b - a);
      const double length = inward.length();
      if (!(length > 0)) continue;
      blocker.inward[blocker.edges] = inward / length;
      blocker.least[blocker.edges] = blocker.inward[blocker.edges].dot(a);
      for (const V3d& corner : corners)
        if (blocker.inward[blocker.edges].dot(corner) < blocker.least[blocker.edges] - kSamePlace)
          return false;
      ++blocker.edges;
      turn += std::atan2((b - a).cross(c - b).dot(polygon->normal), (b - a).dot(c - b));
    }
    return turn < 3 * kPi;
  };
  if (!isConvex()) blocker.edges = 0;
  if (!withArea) return true;
  if (areaOf(blocker)) {
    blocker.box = blocker.area->box();
    const V3d extent = blocker.box.size();
    const auto axis = static_cast<int>(polygon->axis);
    blocker.size = (extent[(axis + 1) % 3] + extent[(axis + 2) % 3]) / 2;
  }
  return blocker.edges > 0 || blocker.area;
}

// Looks up the area of a blocker, as seen from its front. Null if the blocker is convex and alone.
const JoinedPolygons::Area* Blockers::areaOf(Blocker& blocker) const {
  if (blocker.areaIsKnown) return blocker.area;
  const Surface surface = scene_.surfaces[blocker.surface];
  const auto* const area =
      joined_.areaOf(blocker.surface, surface.shape.as<Polygon>()->normal.dot(blocker.normal) > 0);
  blocker.area = area && (area->size() > 1 || blocker.edges == 0) ? area : nullptr;
  blocker.areaIsKnown = true;
  return blocker.area;
}

// Whether every segment from one box to the other hits the front of the blocker (the side from which find()
// saw it) before it reaches anything that refracts light.
//
// This holds for all places within kBeside times margin() of the boxes, too. Places behind a blocker that is
// perpendicular to an axis are an exception, since regions end closer to it.
//
// Sets seesHole if the blocker's area extends far enough to hide the box, but has a hole or a gap.
bool Blockers::covers(Blocker& blocker, const Box3d& from, const Box3d& to, bool& seesHole) const {
  Box3d both = from;
  both.extendBy(to);
  const double margin = marginOver(both.size().length());
  const double apart = blocker.axis() < 0 ? margin + kBeside * margin_ : margin;
  const double inset = margin + kBeside * margin_;
  const std::array<V3d, 8> begins = cornersOf(from), ends = cornersOf(to);
  std::array<double, 8> above, below;
  for (size_t i = 0; i < 8; ++i) {
    above[i] = blocker.normal.dot(begins[i]) - blocker.offset;
    below[i] = blocker.offset - blocker.normal.dot(ends[i]);
    if (above[i] < apart || below[i] < margin) return false;
  }
  Box3d before = from;
  std::array<V3d, 64> cuts;
  bool single = blocker.edges > 0;
  const JoinedPolygons::Area* area = blocker.area;
  for (size_t i = 0; i < 8; ++i)
    for (size_t j = 0; j < 8; ++j) {
      const double t = above[i] / (above[i] + below[j]);
      const V3d cut = begins[i] + t * (ends[j] - begins[i]);
      for (uint32_t e = 0; single && e < blocker.edges; ++e)
        single = !(blocker.inward[e].dot(cut) < blocker.least[e] + inset);
      if (!single && !area) {
        area = areaOf(blocker);
        if (!area) return false;
      }
      if (!single && !area->mayContain(cut, inset)) return false;
      before.extendBy(cut);
      cuts[8 * i + j] = cut;
    }
  if (!single && !area->contains(cuts, inset)) {
    seesHole = true;
    return false;
  }
  for (const Box3d& box : tracer_.refracting())
    if (before.intersects(box)) return false;
  return true;
}

bool Blockers::anyBetween(const V3d& from, const V3d& to, FunctionRef<bool(const Blocker&)> use) const {
  return anySurface(tracer_, from, to, [&](SurfaceId surface) {
    Blocker blocker;
    return find(surface, from, true, blocker) && use(blocker);
  });
}

bool Blockers::hides(const Box3d& from, const Box3d& to, std::vector<Blocker>& known,
                     bool fromBothEnds) const {
  bool seesHole = false;
  for (size_t i = 0; i < known.size(); ++i)
    if (covers(known[i], from, to, seesHole)) {
      std::swap(known[0], known[i]);
      return true;
    }
  int met = 0;
  const auto hidesBy = [&](SurfaceId surface) {
    ++met;
    if (std::any_of(known.begin(), known.end(), [&](const Blocker& b) { return b.surface == surface; }))
      return false;
    Blocker blocker;
    if (!find(surface, from.center(), false, blocker) || !covers(blocker, from, to, seesHole)) return false;
    known.insert(known.begin(), blocker);
    if (known.size() > kMostKnown) known.pop_back();
    return true;
  };
  if (anySurface(tracer_, from.center(), to.center(), hidesBy)) return true;
  return fromBothEnds && seesHole && met == kSurfacesInTheWay &&
         anySurface(tracer_, to.center(), from.center(), hidesBy);
}

}  // namespace rsphere
