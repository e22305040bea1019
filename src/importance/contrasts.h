#pragma once
// Measures how much radiance varies on special objects, compared with the rest of the view. The rays of this
// measurement, one per scene, enter no estimate, so that estimates at points stay unbiased.
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
  // Relative standard deviation of the brightness along one path: the error of a single base direction. 1 if
  // it was not measured.
  double baseError = 1;
};

// Measures the contrasts of the scene. Objects with the same modifier share one measurement. The result
// depends only on the scene and the options. Nothing is traced if there are no objects and no openings.
// sources: the sources that are integrated separately; rays that hit one of them are ignored.
Contrasts measureContrasts(const SphereTracing& tracing, std::span<const SpecialObject> objects,
                           const SeenSources& sources);

// The photopic radiance (W/sr/m2) that points on the scene's surfaces see on average, without sources. It is
// the reference by which points are judged to be dark. It comes from few directions, so that it is right only
// within a small factor; 0 if they found no light. It depends only on the scene and the options.
double typicalRadiance(const SphereTracing& tracing, const SeenSources& sources);

}  // namespace rsphere
