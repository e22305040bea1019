#pragma once
#include <vector>

#include "glare/glare_indices.h"
#include "scene/ids.h"

namespace rsphere {

// A glare source as an eye sees it.
struct GlareSource {
  SurfaceId surface;           // a light source, or the surface that most of the light comes from
  V3d direction{0, 0, 1};      // of the middle of its light, unit
  double luminance = 0;        // mean, cd/m2
  double luminanceError = 0;   // standard error
  double solidAngle = 0;       // of the part that is in view, sr
  double solidAngleError = 0;  // standard error
  double positionIndex = 1;
  double weight = 0;  // L^2 omega / P^2, by which sources are sorted, the largest first
};

// Glare at an eye.
struct GlareAnswer {
  V3d eye{0, 0, 0}, gaze{0, 1, 0};  // gaze: unit
  GlareIndices indices, errors;     // and their standard errors
  double threshold = 0;             // luminance of the darkest regions that are glare sources, cd/m2
  std::vector<GlareSource> sources;
};

}  // namespace rsphere
