#pragma once
// Random choice of one of many light sources, with probability proportional to its estimated unoccluded
// contribution. One or two shadow rays then suffice instead of one for each source (Shirley, Wang and
// Zimmerman 1996, "Monte Carlo techniques for direct lighting calculations", ACM TOG 15/1, section 3).
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "light/sources.h"

namespace rsphere {

class SourceChoice {
 public:
  // Keeps no reference to the scene or to its lights.
  SourceChoice(const Scene& scene, const LightSources& lights);

  // Computes the weight of each source at a point, and returns the sum of the weights. sources: numbers of
  // LightIds. A weight approximates the brightness of the irradiance (W/m2) from the source on a surface with
  // the normal `front` (unit), or from all sides if front is 0. It is above 0 wherever LightSources::sample()
  // can return a sample for this front. Errors of the approximation therefore increase the variance, but
  // cause no bias.
  double weigh(const V3d& point, const V3d& front, std::span<const uint32_t> sources,
               std::vector<double>& weights) const;

 private:
  // Sources at a finite distance. power: brightness times area (W/sr). `everywhere` is 1 for a source that
  // emits in all directions (its normal is 0), and 0 for the others.
  struct Near {
    V3d center, normal;
    double power, radius, everywhere;
    uint32_t special = 0;  // 1 + its index in special_; 0: none
  };
  // Data of a distant source, or additional data of a source with limited reach or a spotlight's cone.
  struct Special {
    bool distant = false;
    V3d direction{0, 0, 0};
    double power = 0, sine = 0;  // power: brightness times solid angle (W/m2)
    double reach = 0;
    std::optional<Spotlight> spot{};
  };
  static double weightOf(const Special& special, const Near& near, const V3d& point, const V3d& front,
                         double usual);

  ById<LightId, Near> near_;  // one for every source; power 0 if distant
  std::vector<Special> special_;
};

}  // namespace rsphere
