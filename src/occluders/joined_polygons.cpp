#include "occluders/joined_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "occluders/tuning.h"

namespace rsphere {
namespace {

// To find polygons in one plane, normals are rounded to multiples of this, and so are offsets, in units in
// which Scene::samePlace is kSamePlace. Decimal fractions are rarely halfway between two multiples.
constexpr double kSameNumber = 1.2345678e-6;

// The largest distance between polygons that touch, relative to their coordinates. It is a few times the
// rounding of coordinates, and the tracer lets no ray pass between such polygons (meetsInside()).
constexpr double kTouching = 16 * std::numeric_limits<double>::epsilon();

// Places on both sides of an edge are tested. Their distance from it is this multiple of the distance within
// which polygons touch.
constexpr double kBeside = 8;

// 1 or -1: the sign that gives all polygons of a plane one common normal.
double signOf(const V3d& normal) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(normal[i]) > .1) return normal[i] > 0 ? 1 : -1;
  return 1;
}

uint64_t planeOf(const Polygon& polygon, double samePlace) {
  const double sign = signOf(polygon.normal);
  uint64_t number = 0;
  const std::array values{polygon.normal.x, polygon.normal.y, polygon.normal.z,
                          polygon.offset / (samePlace / kSamePlace)};
  for (const double value : values) {
    const auto rounded = static_cast<int64_t>(std::llround(sign * value / kSameNumber));
    number = (number ^ static_cast<uint64_t>(rounded)) * 0x9e3779b97f4a7c15u;
    number ^= number >> 29;
  }
  return number;
}

// A convex octagon around points of a plane, in the projection along an axis.
class Octagon {
 public:
  explicit Octagon(int axis) : u_((axis + 1) % 3), v_((axis + 2) % 3) {}

  void extendBy(const V3d& point) {
    const auto along = directions(point);
    for (size_t i = 0; i < 4; ++i) {
      least_[i] = std::min(least_[i], along[i]);
      most_[i] = std::max(most_[i], along[i]);
    }
  }
  void growBy(double distance) {
    for (size_t i = 0; i < 4; ++i) {
      const double d = i < 2 ? distance : std::numbers::sqrt2 * distance;
      least_[i] -= d;
      most_[i] += d;
    }
  }
  // Whether it contains a point of the segment.
  bool meets(const V3d& begin, const V3d& end) const {
    const auto from = directions(begin), to = directions(end);
    double first = 0, last = 1;
    for (size_t i = 0; i < 4; ++i) {
      const double way = to[i] - from[i];
      if (way == 0) {
        if (from[i] < least_[i] || from[i] > most_[i]) return false;
        continue;
      }
      const double a = (least_[i] - from[i]) / way, b = (most_[i] - from[i]) / way;
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return first <= last;
  }
  // The part of a box whose projection lies in the octagon's own bounding box.
  Box3d in(Box3d box) const {
    box.min[u_] = least_[0];
    box.max[u_] = most_[0];
    box.min[v_] = least_[1];
    box.max[v_] = most_[1];
    return box;
  }

 private:
  std::array<double, 4> directions(const V3d& p) const {
    return {p[u_], p[v_], p[u_] + p[v_], p[u_] - p[v_]};
  }

  static constexpr double kInfinite = std::numeric_limits<double>::infinity();
  int u_, v_;
  std::array<double, 4> least_{kInfinite, kInfinite, kInfinite, kInfinite};
  std::array<double, 4> most_{-kInfinite, -kInfinite, -kInfinite, -kInfinite};
};

// Numbers that are joined in groups; first() of a group is its smallest number.
class Groups {
 public:
  explicit Groups(size_t size) : joinedTo_(size) { std::iota(joinedTo_.begin(), joinedTo_.end(), 0); }
  uint32_t first(uint32_t i) {
    while (joinedTo_[i] != i) i = joinedTo_[i] = joinedTo_[joinedTo_[i]];
    return i;
  }
  void join(uint32_t i, uint32_t j) {
    const uint32_t a = first(i), b = first(j);
    joinedTo_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> joinedTo_;
};

// An upper bound on the distance between polygons that touch. box: around all of them
double touchingIn(const Box3d& box) {
  double touching = 0;
  for (int i = 0; i < 3; ++i) touching += kTouching * std::max(std::abs(box.min[i]), std::abs(box.max[i]));
  return touching;
}

Box3d around(const V3d& a, const V3d& b, double margin) {
  Box3d box(a);
  box.extendBy(b);
  return {box.min - V3d(margin), box.max + V3d(margin)};
}

}  // namespace

bool JoinedPolygons::Area::contains(std::span<const V3d> points, double margin) const {
  Octagon octagon(axis_);
  for (const V3d& p : points) {
    if (!mayContain(p, margin)) return false;
    octagon.extendBy(p);
  }
  octagon.growBy(margin);
  if (outlineTree_.any(octagon.in(box_),
                       [&](uint32_t i) { return octagon.meets(outline_[i].begin, outline_[i].end); }))
    return false;
  const V3d& one = points.front();
  Box3d place(one);
  place.min[axis_] = box_.min[axis_];
  place.max[axis_] = box_.max[axis_];
  return polygonTree_.any(place, [&](uint32_t i) {
    return inside(*scene_->surfaces[polygons_[i]].shape.as<Polygon>(), scene_->vertices, one);
  });
}

// Finds the areas of polygons in one plane.
class JoinedPolygons::Joining {
 public:
  // polygons: in the plane through the first of them with this normal. They all stop shadow rays from one
  // side.
  Joining(const Scene& scene, const V3d& normal, std::vector<SurfaceId> polygons)
      : scene_(scene), normal_(normal), polygons_(std::move(polygons)), joined_(polygons_.size()) {
    std::vector<Box3d> boxes;
    Box3d all;
    for (const SurfaceId id : polygons_) {
      boxes.push_back(bounds(polygon(id), scene_.vertices));
      all.extendBy(boxes.back());
    }
    touching_ = touchingIn(all);
    for (Box3d& box : boxes) box = {box.min - V3d(beside()), box.max + V3d(beside())};
    tree_ = BoxTree(std::move(boxes));
  }

  Areas find() {
    std::vector<std::pair<uint32_t, Area::Segment>> outline;
    size_t vertices = 0;
    for (uint32_t i = 0; i < polygons_.size(); ++i) vertices += cornersOf(i).size();
    for (uint32_t i = 0; i < polygons_.size(); ++i) {
      const auto corners = cornersOf(i);
      for (size_t e = 0; e < corners.size(); ++e)
        findOutline(i, {corners[e], corners[(e + 1) % corners.size()]}, outline);
      if (compared_ > tuning::JoinedPolygons::kMostCompared * vertices) return {};
    }
    Areas result;
    std::vector<size_t> areaOf(polygons_.size());
    for (uint32_t i = 0; i < polygons_.size(); ++i) {
      const uint32_t first = joined_.first(i);
      if (first == i) {
        areaOf[i] = result.areas.size();
        result.areas.emplace_back();
      }
      areaOf[i] = areaOf[first];
      result.areaOf[static_cast<uint32_t>(polygons_[i].index())] = areaOf[i];
      result.areas[areaOf[i]].polygons_.push_back(polygons_[i]);
    }
    for (const auto& [i, segment] : outline) result.areas[areaOf[i]].outline_.push_back(segment);
    for (Area& area : result.areas) finish(area);
    return result;
  }

 private:
  const Polygon& polygon(SurfaceId id) const { return *scene_.surfaces[id].shape.as<Polygon>(); }
  std::span<const V3d> cornersOf(uint32_t i) const {
    const Polygon& p = polygon(polygons_[i]);
    return std::span(scene_.vertices).subspan(p.firstVertex, p.vertices);
  }
  double beside() const { return kBeside * touching_; }

  // Divides an edge where other edges meet it, and adds those parts to the outline that have opaque polygons
  // on one side only.
  void findOutline(uint32_t index, const Area::Segment& edge,
                   std::vector<std::pair<uint32_t, Area::Segment>>& outline) {
    V3d along = edge.end - edge.begin;
    const double length = along.length(), near = beside();
    if (!(length > 4 * near)) return;
    along /= length;
    const V3d across = normal_.cross(along);
    std::vector<double> ends{0, length};
    const auto addEnd = [&](double at) {
      if (at > 0 && at < length) ends.push_back(at);
    };
    tree_.any(around(edge.begin, edge.end, 0), [&](uint32_t i) {
      const auto corners = cornersOf(i);
      compared_ += corners.size();
      double x0 = along.dot(corners.back() - edge.begin), y0 = across.dot(corners.back() - edge.begin);
      for (const V3d& corner : corners) {
        const double x1 = along.dot(corner - edge.begin), y1 = across.dot(corner - edge.begin);
        if (std::abs(y1) <= 2 * near) addEnd(x1);
        if ((y0 < 0) != (y1 < 0)) addEnd(x0 + (x1 - x0) * (y0 / (y0 - y1)));
        x0 = x1;
        y0 = y1;
      }
      return false;
    });
    std::ranges::sort(ends);
    for (size_t k = 0; k + 1 < ends.size(); ++k) {
      if (!(ends[k + 1] - ends[k] > 4 * near)) continue;
      const V3d middle = edge.begin + .5 * (ends[k] + ends[k + 1]) * along;
      std::array<bool, 2> opaque{};
      for (size_t side = 0; side < 2; ++side) {
        const V3d point = middle + (side == 0 ? near : -near) * across;
        compared_ += tuning::JoinedPolygons::kPerPoint;
        tree_.any(Box3d(point), [&](uint32_t i) {
          if (!inside(polygon(polygons_[i]), scene_.vertices, point)) return false;
          opaque[side] = true;
          joined_.join(index, i);
          return false;
        });
      }
      if (opaque[0] != opaque[1])
        outline.push_back({index, {edge.begin + ends[k] * along, edge.begin + ends[k + 1] * along}});
    }
  }

  void finish(Area& area) const {
    area.scene_ = &scene_;
    std::vector<Box3d> boxes;
    for (const SurfaceId id : area.polygons_) {
      boxes.push_back(bounds(polygon(id), scene_.vertices));
      area.box_.extendBy(boxes.back());
      boxes.back() = {boxes.back().min - V3d(beside()), boxes.back().max + V3d(beside())};
    }
    area.axis_ = static_cast<int>(polygon(area.polygons_.front()).axis);
    area.polygonTree_ = BoxTree(std::move(boxes));
    boxes.clear();
    for (const Area::Segment& s : area.outline_) boxes.push_back(around(s.begin, s.end, beside()));
    area.outlineTree_ = BoxTree(std::move(boxes));
    findHoles(area);
  }

  // Parts of the outline that touch belong to one hole. An area with a hole that touches its edge is not
  // rectangular.
  void findHoles(Area& area) const {
    const auto& boxes = area.outlineTree_.boxes;
    Groups touching(boxes.size());
    const auto isAt = [&](int i, double edge, const Box3d& box) {
      return box.min[i] > edge - 2 * beside() && box.max[i] < edge + 2 * beside();
    };
    const auto isOnEdge = [&](const Box3d& box) {
      for (int i = 0; i < 3; ++i)
        if (i != area.axis_ && (isAt(i, area.box_.min[i], box) || isAt(i, area.box_.max[i], box)))
          return true;
      return false;
    };
    const auto count = static_cast<uint32_t>(boxes.size());
    std::vector<bool> onEdge(count);
    for (uint32_t i = 0; i < count; ++i) onEdge[i] = isOnEdge(boxes[i]);
    std::vector<Box3d> holes(count);
    for (uint32_t i = 0; i < count; ++i) {
      if (onEdge[i]) continue;
      bool meetsEdge = false;
      area.outlineTree_.any(boxes[i], [&](uint32_t other) {
        touching.join(i, other);
        return meetsEdge = onEdge[other];
      });
      if (meetsEdge) return;
    }
    for (uint32_t i = 0; i < count; ++i)
      if (!onEdge[i]) holes[touching.first(i)].extendBy(boxes[i]);
    std::erase_if(holes, [](const Box3d& box) { return box.isEmpty(); });
    area.holes_ = std::move(holes);
  }

  const Scene& scene_;
  const V3d normal_;
  std::vector<SurfaceId> polygons_;
  Groups joined_;
  double touching_ = 0;  // world units
  size_t compared_ = 0;  // number of edges
  BoxTree tree_;         // of the polygons' boxes
};

JoinedPolygons::JoinedPolygons(const Scene& scene, const Tracer& tracer) : scene_(scene), tracer_(tracer) {}
JoinedPolygons::~JoinedPolygons() = default;

static_assert(kShapes == 8, "Does a new shape hide what is behind it?");
void JoinedPolygons::sort() const {
  const Box3d& all = tracer_.bounds();
  const double least = tuning::JoinedPolygons::kLeastSize * all.size()[static_cast<int>(all.majorAxis())];
  for (const SurfaceId id : scene_.outermostIds()) {
    const Surface surface = scene_.surfaces[id];
    const auto* const polygon = surface.shape.as<Polygon>();
    if (!polygon || !polygon->hasArea || polygon->extent < least ||
        polygon->vertices > tuning::JoinedPolygons::kMostVertices)
      continue;
    if (tracer_.stopsShadows(id, true) || tracer_.stopsShadows(id, false))
      polygons_.push_back({planeOf(*polygon, scene_.samePlace), id});
  }
  std::ranges::sort(polygons_, [](const InPlane& a, const InPlane& b) {
    return a.plane != b.plane ? a.plane < b.plane : a.polygon.index() < b.polygon.index();
  });
}

// Groups of polygons in a plane that stop shadow rays from one side of it. side: 1 or -1, as in areaOf().
JoinedPolygons::Plane JoinedPolygons::groupsOf(std::span<const InPlane> plane, double side) const {
  const Surface firstSurface = scene_.surfaces[plane.front().polygon];
  const Polygon& first = *firstSurface.shape.as<Polygon>();
  std::vector<SurfaceId> polygons;
  std::vector<Box3d> boxes;
  Box3d all;
  for (const InPlane& one : plane) {
    const Surface surface = scene_.surfaces[one.polygon];
    const Polygon& polygon = *surface.shape.as<Polygon>();
    if (!tracer_.stopsShadows(one.polygon, side * signOf(polygon.normal) > 0)) continue;
    bool same = true;
    for (const V3d& v : std::span(scene_.vertices).subspan(polygon.firstVertex, polygon.vertices)) {
      const double size = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
      same = same && std::abs(first.normal.dot(v) - first.offset) <= kTouching * size;
    }
    if (!same) continue;
    polygons.push_back(one.polygon);
    boxes.push_back(bounds(polygon, scene_.vertices));
    all.extendBy(boxes.back());
  }
  const V3d near(kBeside * touchingIn(all));
  for (Box3d& box : boxes) box = {box.min - near, box.max + near};
  Plane result;
  const BoxTree tree(std::move(boxes));
  Groups joined(polygons.size());
  size_t compared = 0;
  for (uint32_t i = 0; i < polygons.size(); ++i) {
    tree.any(tree.boxes[i], [&](uint32_t other) {
      joined.join(i, other);
      ++compared;
      return false;
    });
    if (compared > tuning::JoinedPolygons::kMostCompared * polygons.size()) return {};
  }
  for (uint32_t i = 0; i < polygons.size(); ++i) {
    const uint32_t leader = joined.first(i);
    if (leader == i) result.groups.emplace_back();
    const size_t group = leader == i ? result.groups.size() - 1
                                     : result.groupOf[static_cast<uint32_t>(polygons[leader].index())];
    result.groupOf[static_cast<uint32_t>(polygons[i].index())] = group;
    result.groups[group].push_back(polygons[i]);
  }
  result.areas.resize(result.groups.size());
  return result;
}

const JoinedPolygons::Area* JoinedPolygons::areaOf(SurfaceId id, bool front) const {
  std::call_once(sorted_, [&] { sort(); });
  const Surface surface = scene_.surfaces[id];
  const Polygon& asked = *surface.shape.as<Polygon>();
  const uint64_t plane = planeOf(asked, scene_.samePlace);
  const auto [begin, end] =
      std::equal_range(polygons_.begin(), polygons_.end(), InPlane{plane, id},
                       [](const InPlane& a, const InPlane& b) { return a.plane < b.plane; });
  if (begin == end || (end - begin == 1 && asked.vertices <= 4)) return nullptr;
  const double side = (front ? 1 : -1) * signOf(asked.normal);  // 1: seen from where the normal points
  const std::lock_guard lock(joining_);
  auto& known = planes_[plane ^ (side > 0 ? 1 : 0)];
  if (!known) known = std::make_unique<Plane>(groupsOf({begin, end}, side));
  const auto index = static_cast<uint32_t>(id.index());
  const auto group = known->groupOf.find(index);
  if (group == known->groupOf.end()) return nullptr;
  const std::vector<SurfaceId>& polygons = known->groups[group->second];
  if (polygons.size() == 1 && asked.vertices <= 4) return nullptr;
  auto& areas = known->areas[group->second];
  if (!areas) {
    const Surface first = scene_.surfaces[begin->polygon];
    areas =
        std::make_unique<const Areas>(Joining(scene_, first.shape.as<Polygon>()->normal, polygons).find());
  }
  const auto found = areas->areaOf.find(index);
  return found == areas->areaOf.end() ? nullptr : &areas->areas[found->second];
}

}  // namespace rsphere
