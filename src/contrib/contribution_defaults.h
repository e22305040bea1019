#pragma once
#include "transport/ray_options.h"

namespace rsphere {

// Sets the defaults of RADIANCE 6.1's rcontrib, where they differ from those of rtrace.
void setContributionDefaults(RayOptions& options);

// Switches off what contributions cannot have: interpolated light, which has no sources any more, and
// untested sources, which have no shadow.
void limitToContributions(RayOptions& options);

}  // namespace rsphere
