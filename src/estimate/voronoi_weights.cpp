#include "estimate/voronoi_weights.h"

#include <algorithm>

#include "base/even_sequence.h"

namespace rsphere {

std::vector<V3d> VoronoiWeights::dynamicDirections(const SetAtPoint& set) const {
  struct Wanted {
    Silhouette silhouette;
    size_t count;
  };
  std::vector<Wanted> wanted;
  for (const SpecialObject& object : special_) {
    Silhouette s = silhouetteOf(scene_, object, set.point());
    const auto count = static_cast<size_t>(std::min(object.density * s.solidAngle() + .5, 1e9));
    if (count > 0) wanted.push_back({std::move(s), count});
  }
  std::ranges::stable_sort(wanted, [](const auto& a, const auto& b) { return a.count > b.count; });
  const auto most = static_cast<size_t>(options_.mostDirections);
  size_t left = most > base_.directions.size() ? most - base_.directions.size() : 0;
  std::vector<V3d> directions;
  Random random(set.seed());
  for (const Wanted& object : wanted) {
    const double shift1 = random.uniform(), shift2 = random.uniform();
    const size_t count = std::min(object.count, left);
    for (size_t i = 0; i < count; ++i) {
      const Imath::V2d u = evenly(i, shift1, shift2);
      directions.push_back(object.silhouette.sample(u.x, u.y));
    }
    left -= count;
  }
  return directions;
}

SampledSet VoronoiWeights::sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const {
  const std::vector<V3d> dynamic = dynamicDirections(set);
  std::vector<V3d> directions = set.turned(base_.directions);
  directions.insert(directions.end(), dynamic.begin(), dynamic.end());
  const auto solidAngles =
      set.isFirst() ? cellSolidAngles(triangulation_, dynamic, memory) : cellSolidAngles(directions, memory);
  SampledSet sampled = traceEach(set, directions, solidAngles, options_.everyDirection, tracer);
  if (base_.neighbours) sampled.setVariance(neighboursOf(memory), base_);
  return sampled;
}

}  // namespace rsphere
