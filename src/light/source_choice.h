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

  // Sets the weight of each of these sources (numbers of LightIds) at a point: approximately the
  // irradiance (W/m2, of brightness) that it causes on a surface there with the normal `front` (unit), or
  // from all sides if front is 0. The weight is greater than 0 wherever LightSources::sample() can return
  // a sample for the same front, so errors of the approximation increase the variance but cause no bias.
  // Returns the sum of the weights.
  double weigh(const V3d& point, const V3d& front, std::span<const uint32_t> sources,
               std::vector<double>& weights) const;

 private:
  // Sources at a finite distance. power: brightness times area (W/sr). A source that shines to all sides has
  // normal 0 and everywhere 1; the others have everywhere 0.
  struct Near {
    V3d center, normal;
    double power, radius, everywhere;
    uint32_t special = 0;  // from 1: its place in special_
  };
  // What a distant source has instead, and sources of limited reach or with a cone in addition.
  struct Special {
    bool distant = false;
    V3d direction{0, 0, 0};
    double power = 0, sine = 0;  // power: brightness times solid angle (W/m2)
    double reach = 0;
    std::optional<Spotlight> spot{};
  };
  static double weightOf(const Special& special, const Near& near, const V3d& point, const V3d& front,
                         double usual);

  ById<LightId, Near> near_;  // one for every source; that of a distant source has power 0
  std::vector<Special> special_;
};

}  // namespace rsphere
