#include "occluders/hidden_boxes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "occluders/tuning.h"

namespace rsphere {
namespace {

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

struct HiddenBoxes::Region {
  // Shared with the parent region if the division has hidden no further boxes.
  using List = std::shared_ptr<const std::vector<uint32_t>>;

  Box3d box{};
  List visible;  // indices of the boxes that are not certainly hidden, in ascending order
  List places;   // visible boxes that may be hidden from parts of the region: positions in BoxTree::order
  std::vector<KnownBlocker> blockers;
  int inVain = 0;     // number of divisions since the last one that hid a quarter of the boxes
  size_t before = 0;  // number of places after that division
  int untested = 0;   // number of divisions since boxes were last looked for
  int axis = -1;      // the region is divided perpendicular to this axis; -1: not divided
  double at = 0;
  mutable std::array<std::unique_ptr<const Region>, 2> halves;
  mutable std::array<std::atomic<const Region*>, 2> ready{};
};

bool HiddenBoxes::divides() const { return root_ && root_->axis >= 0; }

HiddenBoxes::~HiddenBoxes() = default;
HiddenBoxes::HiddenBoxes(HiddenBoxes&&) noexcept = default;

HiddenBoxes::HiddenBoxes(std::shared_ptr<const Blockers> blockers, std::vector<Box3d> boxes, size_t few)
    : blockers_(std::move(blockers)), tree_(std::move(boxes)), all_(tree_.boxes.size()) {
  std::iota(all_.begin(), all_.end(), 0);
  const Box3d& bounds = blockers_->bounds();
  if (tree_.order.size() <= few || bounds.isEmpty()) return;
  root_ = std::make_unique<Region>();
  // Enlarged, because rounding may place points of the outermost walls outside of the bounds.
  root_->box = {bounds.min - V3d(blockers_->margin()), bounds.max + V3d(blockers_->margin())};
  root_->visible = std::make_shared<const std::vector<uint32_t>>(all_);
  std::vector<uint32_t> places(tree_.order.size());
  std::iota(places.begin(), places.end(), 0);
  root_->places = std::make_shared<const std::vector<uint32_t>>(std::move(places));
  root_->before = tree_.order.size();
  divide(*root_);
}

// Returns the given places that are not hidden from a region. Both lists are in ascending order.
std::vector<uint32_t> HiddenBoxes::visibleFrom(const Box3d& region, std::span<const uint32_t> places,
                                               std::vector<KnownBlocker>& known) const {
  struct Some {
    size_t node;
    std::span<const uint32_t> places;
  };
  const bool fromBothEnds = tree_.order.size() <= tuning::HiddenBoxes::kFewFromBothEnds;
  std::vector<std::span<const uint32_t>> visible;
  // Large groups are tested first. Groups that remain after the last test are treated as visible.
  std::vector<Some> all{{0, places}};
  for (size_t i = 0; i < all.size(); ++i) {
    const auto [index, some] = all[i];
    const BoxTree::Node& node = tree_.nodes[index];
    const bool done = i >= tuning::HiddenBoxes::kMostTests;
    if (some.empty() || (!done && blockers_->hides(region, node.box, known, fromBothEnds))) continue;
    if (done || node.second == 0) {
      visible.push_back(some);
      continue;
    }
    const auto middle = std::ranges::lower_bound(some, tree_.nodes[node.second].begin);
    all.push_back({index + 1, {some.begin(), middle}});
    all.push_back({node.second, {middle, some.end()}});
  }
  std::ranges::sort(visible, {}, [](const auto& some) { return some.front(); });
  std::vector<uint32_t> joined;
  for (const auto& some : visible) joined.insert(joined.end(), some.begin(), some.end());
  return joined;
}

// The polygons that hide boxes from places in a region, each with the number of boxes that it hides, in
// descending order of that number. Empty if dividing the region would not pay.
std::vector<std::pair<KnownBlocker, size_t>> HiddenBoxes::blockersIn(const Region& region) const {
  std::vector<std::pair<KnownBlocker, size_t>> found;
  const double widest = region.box.size()[static_cast<int>(region.box.majorAxis())];
  const size_t step = std::max<size_t>(1, region.places->size() / tuning::HiddenBoxes::kProbes);
  size_t probes = 0, hidden = 0;
  for (size_t i = 0; i < region.places->size(); i += step, ++probes)
    blockers_->anyBetween(middleOfOctant(region.box, probes), tree_.boxOf((*region.places)[i]).center(),
                          [&](const KnownBlocker& blocker) {
                            const Blocker::Whole& whole = blockers_->wholeOf(*blocker);
                            if (widest < tuning::HiddenBoxes::kWorthDividing * whole.size) return true;
                            ++hidden;
                            const auto same = std::ranges::find_if(found, [&](const auto& f) {
                              const auto* area = blockers_->wholeOf(*f.first).area;
                              return area == whole.area && (area || f.first->surface == blocker->surface);
                            });
                            if (same != found.end())
                              ++same->second;
                            else
                              found.emplace_back(blocker, 1);
                            return true;
                          });
  if (hidden * step < tuning::HiddenBoxes::kLeastHidden ||
      static_cast<double>(hidden) < tuning::HiddenBoxes::kWorthHiding * static_cast<double>(probes))
    return {};
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.second > b.second; });
  return found;
}

// Decides whether and where a region is divided. If a polygon extends across most of the region, the region
// is divided along a plane next to the polygon, so that points of the polygon get a thin region. If the
// polygon lies outside the region, it is divided along planes just inside the polygon's edges. This cuts off
// strips that contain points of walls, for example around a floor. The higher a point of the wall is, the
// more boxes below are hidden by the floor: a strip is therefore divided again by distance from the polygon.
// Without a large polygon, a region is divided in the middle.
void HiddenBoxes::divide(Region& region) const {
  if (region.places->size() <= tuning::HiddenBoxes::kLeastHidden) return;
  const auto found = blockersIn(region);
  if (found.empty()) return;
  const Box3d& box = region.box;
  const double margin = blockers_->margin();
  const auto divideAt = [&](int axis, const Box3d& polygon, double inward) {
    for (const double at : {polygon.min[axis] + inward, polygon.max[axis] - inward}) {
      if (!(at > box.min[axis] + margin / 2 && at < box.max[axis] - margin / 2)) continue;
      region.axis = axis;
      region.at = at;
      return true;
    }
    return false;
  };
  const double strip = (1 + Blockers::kBeside) * margin;
  const auto isAtEdge = [&](int axis, const Box3d& polygon) {
    for (int i = 0; i < 3; ++i)
      if (i != axis && (box.max[i] < polygon.min[i] + 2 * strip || box.min[i] > polygon.max[i] - 2 * strip))
        return true;
    return false;
  };
  const auto divideAwayFrom = [&](int axis, const Box3d& polygon) {
    const double below = box.min[axis] - polygon.max[axis], above = polygon.min[axis] - box.max[axis];
    const double near = std::max(below, above);
    if (!(near > 0 && near + box.size()[axis] > tuning::HiddenBoxes::kSameDistance * near)) return false;
    const double apart = std::sqrt(near * (near + box.size()[axis]));
    region.axis = axis;
    region.at = below > 0 ? polygon.max[axis] + apart : polygon.min[axis] - apart;
    return true;
  };
  for (const auto& [blocker, count] : found) {
    const int axis = blocker->axis;
    const Box3d& whole = blockers_->wholeOf(*blocker).box;
    if (axis < 0 || shareAcross(box, whole, axis) < .5) continue;
    if (divideAt(axis, whole, margin)) return;
    for (int other = 0; other < 3; ++other)
      if (other != axis && divideAt(other, whole, strip)) return;
    if (isAtEdge(axis, whole) && divideAwayFrom(axis, whole)) return;
  }
  const auto longest = static_cast<int>(box.majorAxis());
  if (box.size()[longest] < 4 * margin) return;
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
  made->visible = region.visible;
  made->places = region.places;
  made->inVain = region.inVain;
  made->before = region.before;
  const double share = made->box.size()[region.axis] / region.box.size()[region.axis];
  if (share > tuning::HiddenBoxes::kSameRegion && region.untested < tuning::HiddenBoxes::kMostUntested) {
    made->untested = region.untested + 1;
    divide(*made);
  }
  if (made->axis < 0) {
    findVisible(*made);
    if (made->inVain < tuning::HiddenBoxes::kMostInVain) divide(*made);
  }
  region.ready[which].store(made.get(), std::memory_order_release);
  region.halves[which] = std::move(made);
  return *region.halves[which];
}

// Removes boxes from the lists of a region that are hidden from it.
void HiddenBoxes::findVisible(Region& region) const {
  std::vector<uint32_t> places = visibleFrom(region.box, *region.places, region.blockers);
  if (places.size() < region.places->size()) {
    std::vector<bool> hidden(all_.size());
    for (const uint32_t place : *region.places) hidden[tree_.order[place]] = true;
    for (const uint32_t place : places) hidden[tree_.order[place]] = false;
    std::vector<uint32_t> visible;
    for (const uint32_t i : *region.visible)
      if (!hidden[i]) visible.push_back(i);
    region.visible = std::make_shared<const std::vector<uint32_t>>(std::move(visible));
    region.places = std::make_shared<const std::vector<uint32_t>>(std::move(places));
  }
  const bool shrunk = 4 * region.places->size() <= 3 * region.before;
  region.inVain = shrunk ? 0 : region.inVain + 1;
  region.before = shrunk ? region.places->size() : region.before;
  region.untested = 0;
}

// Returns a place in the region in front of the surface of the point, if that surface is perpendicular to an
// axis; otherwise the point itself. A box in front of the surface that is hidden from this place is hidden
// from the point too:
// - A blocker that is not perpendicular to an axis hides the box from all places within Blockers::kBeside
//   times margin() of the region.
// - Any other blocker hides the box from the point too, unless the box lies behind the surface.
V3d HiddenBoxes::beside(const V3d& point, const V3d& front) const {
  const double along = std::max({std::abs(front.x), std::abs(front.y), std::abs(front.z)});
  return along > 1 - 1e-12 ? point + Blockers::kBeside * blockers_->margin() * front : point;
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
