#pragma once
// The tuning constants of this folder (base/tuned.h). They affect the variance of light and the
// computing time, but not the mean.
#include "base/tuned.h"

namespace rsphere::tuning {

// The balance between shadow rays and samples of the lobe in the estimate of rough highlights of sources
// (shared_highlights.cpp).
struct SharedHighlights {
  // If the lobe's density in a direction (per sr) times the solid angle of the source is below this, only
  // shadow rays estimate the light from that direction. Derived: a shadow ray then adds at most a quarter of
  // the light of the whole lobe.
  RSPHERE_DERIVED(SharedHighlights, double, kLeast, .25);
};

// The light sources of a scene (scene_lights.cpp).
struct SceneLights {
  // Up to this number of sources, sampling all of them takes less time than finding those that are hidden
  // (measured).
  static constexpr size_t kFewSources = 16;
};

}  // namespace rsphere::tuning
