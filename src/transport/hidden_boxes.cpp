#include "transport/hidden_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/constants.h"
#include "scene/shape.h"

namespace rsphere {
namespace {

constexpr size_t kMostKnown = 8;  // number of recent blockers that a region keeps
// A region is divided if polygons hide at least the fraction kWorthHiding of its boxes, and at least
// kLeastHidden boxes, from places in it. Division stops after kMostInVain successive divisions none of which
// has hidden a quarter of the boxes. That number must be above five, because it takes five divisions to
// isolate the region on one side of a slab: one along the slab, and one along each of its four edges.
constexpr double kWorthHiding = .4;
constexpr size_t kLeastHidden = 2;
constexpr int kMostInVain = 6;
// Number of boxes that are examined to decide whether a region is divided.
constexpr size_t kProbes = 32;
// Cap on the surfaces that are examined along the way to a box; furniture or glass may stand in front of a
// wall.
constexpr int kSurfacesInTheWay = 6;
// To decide whether to divide a region, only polygons are considered whose size times this factor is at most
// the region's width. For larger polygons, division would gain little.
constexpr double kWorthDividing = .25;
// Cap on the number of tests to find the boxes that are hidden from a region. To keep below it, groups of
// boxes are tested first.
constexpr size_t kMostTests = 4096;
// Polygons with more vertices are rarely convex, and are ignored.
constexpr uint32_t kMostVertices = 8;

// Points of a surface use the region of a place at this distance in front of the surface, in units of
// HiddenBoxes::margin_ (see beside()).
constexpr double kBeside = 2.25;

// The smallest distance of boxes from the plane of a polygon that hides one from the other (world units). It
// is needed because surfaces nearer than kSamePlace to an end of a ray do not block it, and because rays
// whose cosine to a plane is at most kSamePlace miss the plane.
double marginOver(double length) { return 10 * kSamePlace + 2 * kSamePlace * length; }

std::array<V3d, 8> cornersOf(const Box3d& box) {
  std::array<V3d, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {(i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                  (i & 4 ? box.max : box.min).z};
  return corners;
}

int longestAxis(const Box3d& box) {
  const V3d size = box.size();
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

V3d middleOfOctant(const Box3d& box, size_t octant) {
  const auto at = [&](int axis, size_t bit) {
    return box.min[axis] + (octant & bit ? .75 : .25) * (box.max[axis] - box.min[axis]);
  };
  return {at(0, 1), at(1, 2), at(2, 4)};
}

// The fraction of a box that another box covers if both are projected along an axis.
double shareAcross(const Box3d& box, const Box3d& other, int axis) {
  double share = 1;
  for (int i = 0; i < 3; ++i) {
    const double size = box.max[i] - box.min[i];
    if (i == axis || size == 0) continue;
    share *= std::max(0., std::min(box.max[i], other.max[i]) - std::max(box.min[i], other.min[i])) / size;
  }
  return share;
}

}  // namespace

struct HiddenBoxes::Blocker {
  SurfaceId surface;
  V3d normal{0, 0, 0};  // unit, towards the side from which a ray hit it
  double offset = 0;
  double size = 0;  // half the sum of its extents along two axes
  Box3d box{};
  uint32_t edges = 0;
  std::array<V3d, kMostVertices> inward{};
  std::array<double, kMostVertices> least{};  // of each edge: inward . p for its points p

  // The axis that is perpendicular to the polygon's plane; -1 if none.
  int axis() const {
    for (int i = 0; i < 3; ++i)
      if (box.max[i] - box.min[i] <= kSamePlace) return i;
    return -1;
  }
};

struct HiddenBoxes::Region {
  // Shared with the parent region if it hides no more boxes.
  using List = std::shared_ptr<const std::vector<uint32_t>>;

  Box3d box{};
  List visible;  // indices of the boxes that are not certainly hidden, in ascending order
  List places;   // the boxes among these that may be hidden, as places in Tree::order
  std::vector<Blocker> blockers;
  int inVain = 0;     // number of divisions since the last one that hid a quarter of the boxes
  size_t before = 0;  // number of places after that division
  int axis = -1;      // the region is divided perpendicular to this axis; -1: not divided
  double at = 0;
  mutable std::array<std::unique_ptr<const Region>, 2> halves;
  mutable std::array<std::atomic<const Region*>, 2> ready{};
};

bool HiddenBoxes::divides() const { return root_ && root_->axis >= 0; }

HiddenBoxes::~HiddenBoxes() = default;
HiddenBoxes::HiddenBoxes(HiddenBoxes&&) noexcept = default;

HiddenBoxes::HiddenBoxes(const Scene& scene, const Tracer& tracer, std::vector<Box3d> boxes, size_t few)
    : scene_(scene), tracer_(tracer), all_(boxes.size()) {
  tree_.boxes = std::move(boxes);
  std::iota(all_.begin(), all_.end(), 0);
  for (const uint32_t i : all_) (tree_.boxes[i].isEmpty() ? never_ : tree_.order).push_back(i);
  if (tree_.order.size() <= few || tracer.bounds().isEmpty()) return;
  tree_.makeNode(0, tree_.order.size());
  margin_ = 2 * marginOver(tracer.bounds().size().length());
  root_ = std::make_unique<Region>();
  // Enlarged, because rounding may place points of the outermost walls outside of the bounds.
  root_->box = {tracer.bounds().min - V3d(margin_), tracer.bounds().max + V3d(margin_)};
  root_->visible = std::make_shared<const std::vector<uint32_t>>(all_);
  std::vector<uint32_t> places(tree_.order.size());
  std::iota(places.begin(), places.end(), 0);
  root_->places = std::make_shared<const std::vector<uint32_t>>(std::move(places));
  root_->before = tree_.order.size();
  divide(*root_);
}

// Makes the subtree for the places from begin to end. Returns its index.
size_t HiddenBoxes::Tree::makeNode(size_t begin, size_t end) {
  const size_t index = nodes.size();
  Box3d box;
  for (size_t i = begin; i < end; ++i) box.extendBy(boxOf(i));
  nodes.push_back({box, begin, end, 0});
  if (end - begin <= 1) return index;
  const int axis = longestAxis(box);
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [&](size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
    const double x = boxes[a].center()[axis], y = boxes[b].center()[axis];
    return x != y ? x < y : a < b;
  });
  makeNode(begin, middle);
  const size_t second = makeNode(middle, end);
  nodes[index].second = second;
  return index;
}

static_assert(kShapes == 8, "Does a new shape hide what is behind it?");
// Makes an opaque convex polygon of the scene itself a blocker for rays from a point. False if the surface is
// not such a polygon.
bool HiddenBoxes::findBlocker(SurfaceId id, const V3d& from, Blocker& blocker) const {
  if (id.index() >= scene_.outermostIds().size()) return false;
  const Surface surface = scene_.surfaces[id];
  const auto* const polygon = surface.shape.as<Polygon>();
  if (!polygon || !polygon->hasArea || polygon->vertices > kMostVertices) return false;
  const double side = polygon->normal.dot(from) - polygon->offset;
  if (!tracer_.stopsShadows(id, side > 0)) return false;
  if (thicknessOf(*polygon, scene_.vertices) > kSamePlace) return false;
  const double sign = side > 0 ? 1 : -1;
  blocker = {.surface = id, .normal = sign * polygon->normal, .offset = sign * polygon->offset};
  blocker.size = polygon->extent / 2;
  blocker.box = bounds(*polygon, scene_.vertices);
  const auto corners = std::span(scene_.vertices).subspan(polygon->firstVertex, polygon->vertices);
  // A polygon is convex if all vertices lie on the inner side of all edges and the edges make one full turn.
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
      if (blocker.inward[blocker.edges].dot(corner) < blocker.least[blocker.edges] - kSamePlace) return false;
    ++blocker.edges;
    turn += std::atan2((b - a).cross(c - b).dot(polygon->normal), (b - a).dot(c - b));
  }
  return turn < 3 * kPi;
}

// Whether every segment from one box to the other hits the front of the polygon (the side from which
// findBlocker() saw it) before it reaches anything that refracts light.
bool HiddenBoxes::covers(const Blocker& blocker, const Box3d& from, const Box3d& to) const {
  Box3d both = from;
  both.extendBy(to);
  const double margin = marginOver(both.size().length());
  // See beside().
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
  for (size_t i = 0; i < 8; ++i)
    for (size_t j = 0; j < 8; ++j) {
      const double t = above[i] / (above[i] + below[j]);
      const V3d cut = begins[i] + t * (ends[j] - begins[i]);
      for (uint32_t e = 0; e < blocker.edges; ++e)
        if (blocker.inward[e].dot(cut) < blocker.least[e] + inset) return false;
      before.extendBy(cut);
    }
  for (const Box3d& box : tracer_.refracting())
    if (before.intersects(box)) return false;
  return true;
}

// Calls use() with each polygon between two points that may be a blocker, until use() returns true. Returns
// whether it has returned true.
bool HiddenBoxes::anyBlocker(const V3d& from, const V3d& to, FunctionRef<bool(const Blocker&)> use) const {
  V3d way = to - from, origin = from;
  double left = way.length() - kSamePlace;
  if (!(left > 0)) return false;
  way.normalize();
  SurfaceId last = kNone;
  for (int i = 0; i < kSurfacesInTheWay && left > 0; ++i) {
    const Hit hit = tracer_.nearest(origin, way, left, last);
    if (hit.surface == kNone) return false;
    Blocker blocker;
    if (findBlocker(hit.surface, from, blocker) && use(blocker)) return true;
    origin += hit.distance * way;
    left -= hit.distance;
    last = hit.surface;
  }
  return false;
}

bool HiddenBoxes::hides(const Box3d& from, const Box3d& to) const {
  std::vector<Blocker> known;
  return hides(from, to, known);
}

// known: blockers that were found for nearby boxes. The first of them was the last one that hid a box.
bool HiddenBoxes::hides(const Box3d& from, const Box3d& to, std::vector<Blocker>& known) const {
  for (size_t i = 0; i < known.size(); ++i)
    if (covers(known[i], from, to)) {
      std::swap(known[0], known[i]);
      return true;
    }
  return anyBlocker(from.center(), to.center(), [&](const Blocker& blocker) {
    const auto isIt = [&](const Blocker& b) { return b.surface == blocker.surface; };
    if (std::any_of(known.begin(), known.end(), isIt) || !covers(blocker, from, to)) return false;
    known.insert(known.begin(), blocker);
    if (known.size() > kMostKnown) known.pop_back();
    return true;
  });
}

// Returns the given places that are not hidden from a region. Both lists are in ascending order.
std::vector<uint32_t> HiddenBoxes::visibleFrom(const Box3d& region, std::span<const uint32_t> places,
                                               std::vector<Blocker>& known) const {
  struct Some {
    size_t node;
    std::span<const uint32_t> places;
  };
  std::vector<uint32_t> visible;
  // Large groups are tested first. Groups that remain after kMostTests tests are treated as visible.
  std::vector<Some> all{{0, places}};
  for (size_t i = 0; i < all.size(); ++i) {
    const auto [index, some] = all[i];
    const Tree::Node& node = tree_.nodes[index];
    const bool done = i >= kMostTests;
    if (some.empty() || (!done && hides(region, node.box, known))) continue;
    if (done || node.second == 0) {
      visible.insert(visible.end(), some.begin(), some.end());
      continue;
    }
    const auto middle = std::lower_bound(some.begin(), some.end(), tree_.nodes[node.second].begin);
    all.push_back({index + 1, {some.begin(), middle}});
    all.push_back({node.second, {middle, some.end()}});
  }
  std::sort(visible.begin(), visible.end());
  return visible;
}

// The polygons that hide boxes from places in a region, each with the number of boxes that it hides, in
// descending order of that number. Empty if dividing the region would not pay.
std::vector<std::pair<HiddenBoxes::Blocker, size_t>> HiddenBoxes::blockersIn(const Region& region) const {
  std::vector<std::pair<Blocker, size_t>> found;
  const double widest = region.box.size()[longestAxis(region.box)];
  const size_t step = std::max<size_t>(1, region.places->size() / kProbes);
  size_t probes = 0, hidden = 0;
  for (size_t i = 0; i < region.places->size(); i += step, ++probes)
    anyBlocker(middleOfOctant(region.box, probes), tree_.boxOf((*region.places)[i]).center(),
               [&](const Blocker& blocker) {
                 if (widest < kWorthDividing * blocker.size) return true;
                 ++hidden;
                 const auto same = std::find_if(found.begin(), found.end(), [&](const auto& f) {
                   return f.first.surface == blocker.surface;
                 });
                 if (same != found.end())
                   ++same->second;
                 else
                   found.emplace_back(blocker, 1);
                 return true;
               });
  if (hidden * step < kLeastHidden ||
      static_cast<double>(hidden) < kWorthHiding * static_cast<double>(probes))
    return {};
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return found;
}

// Decides whether and where a region is divided. If a polygon extends across most of the region, the region
// is divided along a plane next to the polygon, so that points of the polygon get a thin region. If the
// polygon lies outside the region, it is divided along planes just inside the polygon's edges. Without such a
// polygon, it is divided in the middle.
void HiddenBoxes::divide(Region& region) const {
  if (region.places->size() <= kLeastHidden) return;
  const auto found = blockersIn(region);
  if (found.empty()) return;
  const Box3d& box = region.box;
  const auto divideAt = [&](int axis, const Box3d& polygon, double inward) {
    for (const double at : {polygon.min[axis] + inward, polygon.max[axis] - inward}) {
      if (!(at > box.min[axis] + margin_ / 2 && at < box.max[axis] - margin_ / 2)) continue;
      region.axis = axis;
      region.at = at;
      return true;
    }
    return false;
  };
  for (const auto& [blocker, count] : found) {
    const int axis = blocker.axis();
    if (axis < 0 || shareAcross(box, blocker.box, axis) < .5) continue;
    if (divideAt(axis, blocker.box, margin_)) return;
    for (int other = 0; other < 3; ++other)
      if (other != axis && divideAt(other, blocker.box, (1 + kBeside) * margin_)) return;
  }
  const int longest = longestAxis(box);
  if (box.size()[longest] < 4 * margin_) return;
  region.axis = longest;
  region.at = box.center()[longest];
}

const HiddenBoxes::Region& HiddenBoxes::half(const Region& region, int upper) const {
  const size_t which = static_cast<size_t>(upper);
  if (const Region* const ready = region.ready[which].load(std::memory_order_acquire)) return *ready;
  const std::lock_guard lock(*dividing_);
  if (const Region* const ready = region.ready[which].load(std::memory_order_relaxed)) return *ready;
  auto made = std::make_unique<Region>();
  made->box = region.box;
  (upper ? made->box.min : made->box.max)[region.axis] = region.at;
  made->blockers = region.blockers;
  std::vector<uint32_t> places = visibleFrom(made->box, *region.places, made->blockers);
  made->visible = region.visible;
  made->places = region.places;
  if (places.size() < region.places->size()) {
    std::vector<uint32_t> visible = never_;
    for (const uint32_t place : places) visible.push_back(tree_.order[place]);
    std::sort(visible.begin(), visible.end());
    made->visible = std::make_shared<const std::vector<uint32_t>>(std::move(visible));
    made->places = std::make_shared<const std::vector<uint32_t>>(std::move(places));
  }
  const bool shrunk = 4 * made->places->size() <= 3 * region.before;
  made->inVain = shrunk ? 0 : region.inVain + 1;
  made->before = shrunk ? made->places->size() : region.before;
  if (made->inVain < kMostInVain) divide(*made);
  region.ready[which].store(made.get(), std::memory_order_release);
  region.halves[which] = std::move(made);
  return *region.halves[which];
}

// For a point of a surface that is perpendicular to an axis: a place in the region in front of the surface.
// For other points: the point itself. Every box in front of the surface that is hidden from that place is
// hidden from the point too:
// - Blockers that are not perpendicular to an axis hide it from all places within kBeside of the region,
//   because covers() requires that.
// - Other blockers hide it from the point too, unless it lies behind the surface.
V3d HiddenBoxes::beside(const V3d& point, const V3d& front) const {
  const double along = std::max({std::abs(front.x), std::abs(front.y), std::abs(front.z)});
  return along > 1 - 1e-12 ? point + kBeside * margin_ * front : point;
}

std::span<const uint32_t> HiddenBoxes::find(const V3d& point) const {
  return widestWhere(point, [](std::span<const uint32_t>) { return false; });
}

std::span<const uint32_t> HiddenBoxes::widestWhere(
    const V3d& point, FunctionRef<bool(std::span<const uint32_t>)> enough) const {
  if (!root_ || !root_->box.intersects(point)) return all_;
  const Region* region = root_.get();
  while (region->axis >= 0 && !enough(*region->visible))
    region = &half(*region, point[region->axis] >= region->at);
  return *region->visible;
}

}  // namespace rsphere
