#pragma once
#include "rays/ray_options.h"

namespace rsphere {

// Sets those defaults of RADIANCE 6.1's rcontrib that differ from rtrace's.
inline void setContributionDefaults(RayOptions& options) {
  options.ambientBounces = 1;
  options.ambientDivisions = 350;
  options.ambientSuperSamples = 0;
  options.firstRays = 0;
  options.ambientAccuracy = 0;
  options.directThreshold = 0;
  options.directJitter = .9;
  options.directRelays = 3;
  options.specularThreshold = .02;
  options.weightLimit = 2e-3;
}

// Disables options that contributions cannot use: interpolated light, because its sources are unknown, and
// untested sources, because they ignore shadows.
inline void limitToContributions(RayOptions& options) {
  options.ambientAccuracy = 0;
  options.ambientSuperSamples = 0;
  options.directThreshold = 0;
  options.ambientFile.clear();
}

}  // namespace rsphere
