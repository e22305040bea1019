#include "targets/sunlit_targets.h"

#include <algorithm>

#include "targets/tuning.h"

namespace rsphere {
namespace {

// The corners of a box, without duplicates: the box around a flat surface is flat.
std::vector<V3d> cornersOf(const Box3d& box) {
  constexpr double kFlat = 1e-6;  // of the diagonal; the rest is rounding
  std::vector<V3d> corners{box.min};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.size()[axis] > kFlat * box.size().length())) continue;
    for (size_t i = 0, n = corners.size(); i < n; ++i) {
      corners.push_back(corners[i]);
      corners.back()[axis] = box.max[axis];
    }
  }
  return corners;
}

bool isVisible(const Tracer& tracer, const BrightSpots::Sunlit& spot, const V3d& point) {
  return std::any_of(spot.places.begin(), spot.places.end(), [&](const V3d& place) {
    const V3d way = place - point;
    const double distance = way.length();
    return way.dot(spot.normal) < 0 && tracer.shadow(point, way / distance, distance * (1 - 1e-6), kNone,
                                                     nullptr, kInSpace) != Shadow::blocked;
  });
}

}  // namespace

SunlitTargets::SunlitTargets(const TargetScene& scene) : tracer_(scene.tracing.prepared.tracer()) {
  if (const auto* const spots = scene.tracing.aims.of<BrightSpots>()) spots_ = spots->sunlit();
}

std::vector<FoundRegion> SunlitTargets::find(const V3d& point, double usual) const {
  std::vector<FoundRegion> found;
  for (const BrightSpots::Sunlit& spot : spots_)
    if (const double deviation = tuning::Targets::kPartlyLit * spot.radiance;
        deviation > usual && isVisible(tracer_, spot, point))
      found.push_back({hullOf(cornersOf(spot.box), point), deviation});
  return found;
}

}  // namespace rsphere
