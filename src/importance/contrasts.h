#pragma once
// How much radiance varies on special objects, compared with how much it varies elsewhere. It is
// measured once per scene with rays whose values are used for nothing else, so that the estimates
// at points stay unbiased.
#include <span>
#include <vector>

#include "importance/seen_sources.h"
#include "importance/special_objects.h"
#include "importance/sphere_tracing.h"

namespace rsphere {

struct Contrasts {
  struct Object {
    SpecialObject object;
    double deviation = 0;  // standard deviation of the brightness on it, W/sr/m2
  };
  std::vector<Object> objects;
  // The standard deviation of the brightness along one path, relative to its mean: the error of one base
  // direction. 1 if it was not measured.
  double baseError = 1;
};

// Measures the contrasts of the scene. Objects with the same modifier share one measurement. The result
// depends on the scene and the options alone. Without objects and openings nothing is traced. sources: the
// sources that are integrated separately; rays that hit one are left out.
Contrasts measureContrasts(const SphereTracing& tracing, std::span<const SpecialObject> objects,
                           const SeenSources& sources);

// The photopic radiance (W/sr/m2) that points of the scene's surfaces see on average, without sources. Points
// are judged to be dark in comparison with it. Few directions measure it, so that it is right only within a
// small factor; 0 if they found no light. It depends on the scene and the options alone.
double typicalRadiance(const SphereTracing& tracing, const SeenSources& sources);

}  // namespace rsphere
