#pragma once
#include "rays/ray_options.h"

namespace rsphere {

// Sets those defaults of RADIANCE 6.1's rcontrib that differ from rtrace's.
void setContributionDefaults(RayOptions& options);

// Disables options that contributions cannot use: interpolated light, because its sources are unknown, and
// untested sources, because they ignore shadows.
void limitToContributions(RayOptions& options);

}  // namespace rsphere
