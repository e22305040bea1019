#include "occluders/blockers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "occluders/tuning.h"
#include "scene/shape.h"

namespace rsphere {
namespace {

// The smallest distance that boxes must have from the plane of a polygon that hides one box from the other
// (world units). Without it, rays could pass the polygon: a surface nearer than Scene::samePlace to an end of
// a ray does not block it, and a ray whose cosine to a plane is at most kSamePlace misses the plane.
double marginOver(double length, double samePlace) { return 10 * samePlace + 2 * kSamePlace * length; }

// The corners of a box, and how far they lie in front of the plane of a blocker (world units). If the blocker
// is perpendicular to an axis, the first four lie in one plane parallel to it, the others opposite of them.
struct Corners {
  std::array<V3d, 8> at;
  std::array<double, 8> above;
  Corners(const Box3d& box, const Blocker& blocker) {
    const int axis = std::max(blocker.axis, 0), u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (size_t i = 0; i < 8; ++i) {
      at[i][u] = (i & 1 ? box.max : box.min)[u];
      at[i][v] = (i & 2 ? box.max : box.min)[v];
      at[i][axis] = (i & 4 ? box.max : box.min)[axis];
      above[i] = blocker.normal.dot(at[i]) - blocker.offset;
    }
  }
};

// Calls use() with the surfaces between two points, in the order of a ray, until it returns true. Returns
// whether it has returned true.
bool anySurface(const Tracer& tracer, const V3d& from, const V3d& to, FunctionRef<bool(SurfaceId)> use) {
  V3d way = to - from, origin = from;
  double left = way.length() - tracer.samePlace();
  if (!(left > 0)) return false;
  way.normalize();
  SurfaceId last = kNone;
  for (int i = 0; i < tuning::Blockers::kSurfacesInTheWay && left > 0; ++i) {
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

Blockers::Blockers(const Scene& scene, const Tracer& tracer)
    : scene_(scene), tracer_(tracer), joined_(scene, tracer) {
  if (!tracer.bounds().isEmpty()) margin_ = 2 * marginOver(tracer.bounds().size().length(), scene.samePlace);
}

static_assert(kShapes == 8, "Does a new shape hide what is behind it?");

// The opaque polygon of the scene itself as a blocker for rays from a point; null if it cannot be one.
KnownBlocker Blockers::find(SurfaceId id, const V3d& from) const {
  if (id.index() >= scene_.outermostIds().size()) return nullptr;
  const Surface surface = scene_.surfaces[id];
  const auto* const polygon = surface.shape.as<Polygon>();
  if (!polygon || !polygon->hasArea) return nullptr;
  const bool front = polygon->normal.dot(from) > polygon->offset;
  const uint64_t key = 2 * static_cast<uint64_t>(id.index()) + front;
  const std::lock_guard lock(finding_);
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  KnownBlocker blocker = made(id, *polygon, front);
  if (found_.size() < tuning::Blockers::kMostFound) found_.emplace(key, blocker);
  return blocker;
}

// A polygon is convex if all vertices lie on the inner side of all edges and the edges make one full turn.
KnownBlocker Blockers::made(SurfaceId id, const Polygon& polygon, bool front) const {
  if (!tracer_.stopsShadows(id, front) || thicknessOf(polygon, scene_.vertices) > scene_.samePlace)
    return nullptr;
  auto blocker = std::make_shared<Blocker>();
  const double sign = front ? 1 : -1;
  blocker->surface = id;
  blocker->normal = sign * polygon.normal;
  blocker->offset = sign * polygon.offset;
  blocker->whole = {nullptr, rsphere::bounds(polygon, scene_.vertices), polygon.extent / 2};
  const V3d size = blocker->whole.box.size();
  for (int i = 2; i >= 0; --i)
    if (size[i] <= scene_.samePlace) blocker->axis = i;
  const auto corners = std::span(scene_.vertices).subspan(polygon.firstVertex, polygon.vertices);
  const auto isConvex = [&] {
    if (corners.size() > Blocker::kMostVertices) return false;
    double turn = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const V3d& a = corners[i];
      const V3d& b = corners[(i + 1) % corners.size()];
      const V3d& c = corners[(i + 2) % corners.size()];
      const V3d inward = polygon.normal.cross(b - a);
      const double length = inward.length();
      if (!(length > 0)) continue;
      V3d& edge = blocker->inward[blocker->edges];
      edge = inward / length;
      blocker->least[blocker->edges] = edge.dot(a);
      for (const V3d& corner : corners)
        if (edge.dot(corner) < blocker->least[blocker->edges] - scene_.samePlace) return false;
      ++blocker->edges;
      turn += std::atan2((b - a).cross(c - b).dot(polygon.normal), (b - a).dot(c - b));
    }
    return turn < 3 * kPi;
  };
  if (!isConvex()) blocker->edges = 0;
  return blocker;
}

// The area is only looked up when it is needed, because most polygons can be rejected in less time.
const Blocker::Whole& Blockers::wholeOf(const Blocker& blocker) const {
  std::call_once(blocker.lookedUp, [&] {
    const Surface surface = scene_.surfaces[blocker.surface];
    const auto* const polygon = surface.shape.as<Polygon>();
    const auto* const area = joined_.areaOf(blocker.surface, polygon->normal.dot(blocker.normal) > 0);
    if (!area || (area->size() == 1 && blocker.edges > 0)) return;
    const V3d extent = area->box().size();
    const auto axis = static_cast<int>(polygon->axis);
    blocker.whole = {area, area->box(), (extent[(axis + 1) % 3] + extent[(axis + 2) % 3]) / 2};
  });
  return blocker.whole;
}

// The segments from one box to another, and the results so far of the search for a blocker.
struct Blockers::Way {
  // Narrowed to the parts that are visible through the holes of the areas examined so far.
  Box3d from;
  Box3d to;
  // Whether an area extends far enough to hide the box, but has a hole or a gap.
  bool seesHole = false;
  bool wasTried = false;  // whether a segment that misses a polygon has been traced
  bool isOpen = false;    // whether nothing blocks that segment, so that there is no blocker

  bool missesFirst() { return !std::exchange(wasTried, true); }
  bool narrowToHoles(const JoinedPolygons::Area& area, int axis, std::span<const V3d> cuts, double inset);
};

// Narrows each box to the part that is visible from the other box through the holes of an area. Returns true
// if nothing is visible. axis: perpendicular to the area; cuts: where segments between the boxes' corners
// intersect it.
bool Blockers::Way::narrowToHoles(const JoinedPolygons::Area& area, int axis, std::span<const V3d> cuts,
                                  double inset) {
  Box3d all, open;
  for (const V3d& cut : cuts) all.extendBy(cut);
  for (Box3d hole : area.holes()) {
    hole = {hole.min - V3d(inset), hole.max + V3d(inset)};
    if (!hole.intersects(all)) continue;
    for (int i = 0; i < 3; ++i) {
      open.min[i] = std::min(open.min[i], std::max(hole.min[i], all.min[i]));
      open.max[i] = std::max(open.max[i], std::min(hole.max[i], all.max[i]));
    }
  }
  if (open.isEmpty()) return false;
  const double plane = cuts.front()[axis];
  const auto distances = [&](const Box3d& box) {
    return std::minmax({std::abs(box.min[axis] - plane), std::abs(box.max[axis] - plane)});
  };
  const auto narrow = [&](Box3d& box, const Box3d& other) {
    const auto [boxLeast, boxMost] = distances(box);
    const auto [otherLeast, otherMost] = distances(other);
    // The cut divides a segment at this fraction of its length, counted from the other box.
    const double least = otherLeast / (otherLeast + boxMost), most = otherMost / (otherMost + boxLeast);
    for (int i = 0; i < 3; ++i) {
      if (i == axis) continue;
      const double up = open.max[i] - other.min[i], down = open.min[i] - other.max[i];
      box.max[i] = std::min(box.max[i], other.min[i] + up / (up > 0 ? least : most));
      box.min[i] = std::max(box.min[i], other.max[i] + down / (down < 0 ? least : most));
      if (box.min[i] > box.max[i]) return true;
    }
    return false;
  };
  return narrow(from, to) || narrow(to, from);
}

bool Blockers::isClear(const V3d& from, const V3d& to) const {
  V3d way = to - from;
  const double length = way.length();
  return length > 0 && tracer_.shadow(from, way / length, length - scene_.samePlace, kNone) == Shadow::clear;
}

// Whether every segment from one box to the other hits the front of the blocker (the side from which find()
// saw it) before it reaches anything that refracts light.
//
// The result also holds for all places within kBeside times margin() of the boxes. Places behind a blocker
// that is perpendicular to an axis are an exception, since regions end closer to it.
//
// If a segment misses the polygon, tests whether anything blocks the segment before looking up the area,
// which may take long.
//
// If some segments pass through holes, the boxes are narrowed to the ends of such segments. Slabs whose holes
// are not above one another may then hide a box together.
bool Blockers::covers(const Blocker& blocker, Way& way) const {
  const Box3d from = way.from, to = way.to;
  Box3d both = from;
  both.extendBy(to);
  const double margin = marginOver(both.size().length(), scene_.samePlace);
  const double apart = blocker.axis < 0 ? margin + kBeside * margin_ : margin;
  const double inset = margin + kBeside * margin_;
  const Corners begins(from, blocker), ends(to, blocker);
  for (size_t i = 0; i < 8; ++i)
    if (begins.above[i] < apart || -ends.above[i] < margin) return false;
  Box3d before = from;
  std::array<V3d, 64> all;
  size_t count = 0;
  bool single = blocker.edges > 0;
  const JoinedPolygons::Area* area = nullptr;
  for (size_t i = 0; i < 8; ++i)
    for (size_t j = 0; j < 8; ++j) {
      // The segments from a rectangle to a parallel one meet a plane between them in a rectangle, whose
      // corners are on the segments between corresponding corners.
      if (blocker.axis >= 0 && i % 4 != j % 4) continue;
      const V3d begin = begins.at[i], end = ends.at[j];
      const V3d cut = begin + begins.above[i] / (begins.above[i] - ends.above[j]) * (end - begin);
      for (uint32_t e = 0; single && e < blocker.edges; ++e)
        single = !(blocker.inward[e].dot(cut) < blocker.least[e] + inset);
      if (!single && !area) {
        if (way.missesFirst()) way.isOpen = isClear(begin, end);
        if (way.isOpen) return false;
        area = wholeOf(blocker).area;
        if (!area) return false;
      }
      if (!single && !area->mayContain(cut, inset)) return false;
      before.extendBy(cut);
      all[count++] = cut;
    }
  const std::span<const V3d> cuts = std::span(all).first(count);
  const auto meets = [&](const Box3d& box) { return before.intersects(box); };
  const bool covered = single || area->contains(cuts, inset);
  way.seesHole = way.seesHole || !covered;
  if (std::ranges::any_of(tracer_.refracting(), meets)) return false;
  return covered || (blocker.axis >= 0 && way.narrowToHoles(*area, blocker.axis, cuts, inset));
}

bool Blockers::anyBetween(const V3d& from, const V3d& to, FunctionRef<bool(const KnownBlocker&)> use) const {
  return anySurface(tracer_, from, to, [&](SurfaceId surface) {
    const KnownBlocker blocker = find(surface, from);
    return blocker && (blocker->edges > 0 || wholeOf(*blocker).area) && use(blocker);
  });
}

bool Blockers::hides(const Box3d& from, const Box3d& to, std::vector<KnownBlocker>& known,
                     bool fromBothEnds) const {
  if (from.intersects(to)) return false;
  Way way{from, to};
  for (size_t i = 0; i < known.size(); ++i) {
    if (covers(*known[i], way)) {
      std::swap(known[0], known[i]);
      return true;
    }
    if (way.isOpen) return false;
  }
  int met = 0;
  const auto hidesBy = [&](SurfaceId surface) {
    ++met;
    if (std::ranges::any_of(known, [&](const auto& b) { return b->surface == surface; })) return false;
    KnownBlocker blocker = find(surface, from.center());
    if (!blocker || !covers(*blocker, way)) return way.isOpen;
    known.insert(known.begin(), std::move(blocker));
    if (known.size() > tuning::Blockers::kMostKnown) known.pop_back();
    return true;
  };
  // Next to the smaller box, the segments are closest together, so that they miss most holes.
  V3d begin = from.center(), end = to.center();
  if (to.size().length2() < from.size().length2()) std::swap(begin, end);
  if (anySurface(tracer_, begin, end, hidesBy)) return !way.isOpen;
  return fromBothEnds && way.seesHole && met == tuning::Blockers::kSurfacesInTheWay &&
         anySurface(tracer_, end, begin, hidesBy) && !way.isOpen;
}

}  // namespace rsphere
