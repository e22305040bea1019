#include "targets/opening_targets.h"

#include <algorithm>

#include "targets/special_targets.h"
#include "targets/tuning.h"

namespace rsphere {

OpeningTargets::OpeningTargets(const TargetScene& scene) {
  const Openings* const openings = scene.tracing.aims.of<Openings>();
  if (!openings) return;
  for (const Opening& opening : openings->all())
    if (std::ranges::none_of(scene.objects, [&](const SpecialObject& object) {
          return liesIn(scene.tracing.prepared.scene(), object, opening);
        }))
      openings_.push_back(opening);
}

std::vector<FoundRegion> OpeningTargets::find(const V3d& point, double) const {
  std::vector<FoundRegion> found;
  for (const Opening& o : openings_)
    if (o.above(point) > 0)
      found.push_back({hullOf(o.corners(), point), tuning::Targets::kPartlyLit * o.radiance, o.radiance});
  return found;
}

}  // namespace rsphere
