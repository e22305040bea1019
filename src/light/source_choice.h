#pragma once
// One of many light sources, drawn in proportion to what it would bring if nothing were in its way: a shadow
// ray or two are then enough where every source had one of its own (Shirley, Wang and Zimmerman 1996, "Monte
// Carlo techniques for direct lighting calculations", ACM TOG 15/1, section 3).
#include <cstdint>
#include <vector>

#include "light/sources.h"

namespace rsphere {

class SourceChoice {
 public:
  // lights: of the scene, not kept.
  SourceChoice(const Scene& scene, const LightSources& lights);

  // The weight of every source at a point, by its index in LightSources: about the irradiance (W/m2, of
  // luminance) on a surface there with this normal (unit), or from all sides where front is 0. Greater than 0
  // wherever LightSources::sample() can have a sample with front before it; how well it fits decides how much
  // an answer scatters, not what it is in the mean. Returns the sum of the weights.
  double weigh(const V3d& point, const V3d& front, std::vector<double>& weights) const;

 private:
  // Those that are somewhere. power: brightness times area (W/sr). A source that shines to all sides has no
  // normal.
  struct Near {
    V3d center, normal;
    double power, radius, everywhere;
  };
  struct Distant {
    uint32_t source;
    V3d direction;
    double power, sine;  // power: brightness times solid angle (W/m2)
  };
  struct Restricted {
    uint32_t source;
    double reach;
    std::optional<Spotlight> spot;
  };
  std::vector<Near> near_;  // one for every source; of no power: a distant one
  std::vector<Distant> distant_;
  std::vector<Restricted> restricted_;
};

}  // namespace rsphere
