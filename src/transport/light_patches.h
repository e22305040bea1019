#pragma once
// Where surfaces send light from, roughly: particles from the sources are followed through some reflections,
// and each place that they hit is a patch that sends on what it reflects. Densities of directions that are
// made of it change the variance of light, not its mean.
//
// Source: Jensen, "Importance driven path tracing using the photon map" (EGWR 1995).
#include <vector>

#include "transport/prepared_scene.h"

namespace rsphere {

class LightPatches {
 public:
  struct Patch {
    V3d point{0, 0, 0}, normal{0, 0, 1};  // world; unit, on the side that the light arrives at
    double power = 0;                     // that it sends, W of brightness
  };

  // Follows tuning::LightPatches::kParticles particles of the transport's sources through up to -ab diffuse
  // reflections. Keeps no reference. The same scene gives the same patches.
  explicit LightPatches(const PreparedScene& prepared);

  const std::vector<Patch>& all() const { return patches_; }
  // The mean area (square world units) of surfaces for each patch.
  double area() const { return area_; }

 private:
  std::vector<Patch> patches_;
  double area_ = 0;
};

}  // namespace rsphere
