#pragma once
#include <vector>

#include "glare/glare_indices.h"
#include "scene/ids.h"

namespace rsphere {

// A glare source as an eye sees it.
struct GlareSource {
  SurfaceId surface;           // a light source, or the surface that sends most of the light
  V3d direction{0, 0, 1};      // of the middle of its light, unit
  double luminance = 0;        // mean, cd/m2
  double luminanceError = 0;   // standard error
  double solidAngle = 0;       // of the visible part, sr
  double solidAngleError = 0;  // standard error
  double positionIndex = 1;
  double weight = 0;  // L^2 omega / P^2; sources are in descending order of it
};

struct GlareAnswer {
  V3d eye{0, 0, 0}, gaze{0, 1, 0};  // gaze: unit
  GlareIndices indices, errors;     // errors: standard errors
  double threshold = 0;             // luminance above which a region is a glare source, cd/m2
  std::vector<GlareSource> sources;
};

}  // namespace rsphere
