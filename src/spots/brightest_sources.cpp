#include "spots/brightest_sources.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "base/constants.h"
#include "rays/ray_functions.h"

namespace rsphere {
namespace {

// Margin for rounding, so that upper bounds remain valid.
constexpr double kRounding = 1 + 1e-9;

static_assert(kLightForms == 8, "How large can it appear?");
// The largest visible area of a source from any direction (square world units).
double largestArea(const LightSource& source) {
  return match(
      source.shape, [](const PlaneLight& plane) { return plane.area; },
      [&](const BallLight&) { return kPi * source.radius * source.radius; },
      [](const TubeLight& tube) { return tube.area; }, [](const DistantLight&) { return 0.; });
}

double squaredDistance(const Box3d& a, const Box3d& b) {
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    const double apart = std::max({0., a.min[i] - b.max[i], b.min[i] - a.max[i]});
    squared += apart * apart;
  }
  return squared;
}

}  // namespace

BrightestSources::BrightestSources(const Scene& scene, const LightSources& lights)
    : scene_(scene), lights_(lights) {
  std::vector<Box3d> boxes(lights.all().size());
  std::vector<double> powers(boxes.size());
  for (const LightId i : lights.all().ids()) {
    const LightSource& source = lights.all()[i];
    if (source.isVirtual()) continue;
    if (source.isDistant()) {
      distant_.push_back(static_cast<uint32_t>(i.index()));
      continue;
    }
    const double radiance = brightness(sourceRadiance(scene, scene.surfaces[source.surface]));
    if (!(radiance > 0)) continue;
    powers[i.index()] = radiance * largestArea(source);
    boxes[i.index()] = {source.center - V3d(source.radius), source.center + V3d(source.radius)};
  }
  tree_ = BoxTree(std::move(boxes));
  most_.resize(tree_.nodes.size());
  for (size_t node = most_.size(); node-- > 0;) {
    const BoxTree::Node& n = tree_.nodes[node];
    most_[node] = n.second == 0 ? powers[tree_.order[n.begin]] : std::max(most_[node + 1], most_[n.second]);
  }
}

std::vector<LightingPart> BrightestSources::at(const Box3d& places, double radius, size_t most,
                                               FunctionRef<V3d(const LightSource&)> placeFor) const {
  struct Found {
    uint32_t source;
    LightingPart part;
  };
  std::vector<Found> found;
  std::priority_queue<double, std::vector<double>, std::greater<>> brightest;
  const auto add = [&](uint32_t number) {
    const LightSource& source = lights_.all()[LightId(number)];
    const V3d from = placeFor(source);
    for (LightingPart& part : partsThatLight(source, from, radius, scene_)) {
      brightest.push(part.radiance * part.solidAngle(from));
      if (brightest.size() > most) brightest.pop();
      found.push_back({number, std::move(part)});
    }
  };
  for (const uint32_t i : distant_) add(i);
  using Node = std::pair<double, size_t>;  // bound on the light from a part below it; index
  std::priority_queue<Node> open;
  const auto push = [&](size_t node) {
    const double squared = squaredDistance(places, tree_.nodes[node].box);
    open.push(
        {squared > 0 ? kRounding * most_[node] / squared : std::numeric_limits<double>::infinity(), node});
  };
  if (!tree_.nodes.empty()) push(0);
  while (!open.empty()) {
    const auto [bound, node] = open.top();
    if (brightest.size() == most && bound < brightest.top()) break;
    open.pop();
    const BoxTree::Node& n = tree_.nodes[node];
    if (n.second == 0) {
      add(tree_.order[n.begin]);
    } else {
      push(node + 1);
      push(n.second);
    }
  }
  std::ranges::stable_sort(found, {}, &Found::source);
  std::vector<LightingPart> parts;
  for (Found& f : found) parts.push_back(std::move(f.part));
  return parts;
}

}  // namespace rsphere
