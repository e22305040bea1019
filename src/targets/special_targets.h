#pragma once
// Targets that are silhouettes of special objects.
#include <vector>

#include "openings/rectangle.h"
#include "targets/target_finder.h"

namespace rsphere {

class SpecialTargets {
 public:
  explicit SpecialTargets(const TargetScene& scene);
  // See TargetFinder. Their deviations are measured (contrasts.h).
  std::vector<FoundRegion> find(const V3d& point, double usual) const;

 private:
  const Scene& scene_;
  const Contrasts& contrasts_;
  // By index in contrasts_.objects(): the mean radiance (W/sr/m2) of the opening that contains the object, as
  // seen from the dark side; 0 if no opening contains it.
  std::vector<double> daylight_;
};

// Whether the object is a polygon inside the rectangle, within rounding.
bool liesIn(const Scene& scene, const SpecialObject& object, const Rectangle& place);

}  // namespace rsphere
