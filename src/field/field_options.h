#pragma once
#include <cstdint>

#include "base/radiometry.h"

namespace rsphere {

// Settings of the irradiance cache and the coarse solution, most of them given by rtrace's options.
struct FieldOptions {
  int bounces = 0;       // -ab
  double accuracy = .1;  // -aa
  int resolution = 256;  // -ar  0: no limit
  double rays = 1536;    // -ad + -as; the number of rays of a patch is proportional to it
  int solutions = 1;     // independent solutions (coarse_solution.h), which share these rays
  // Patches of the coarse solution that are only seen by other patches are enlarged by this number of levels.
  // Each level doubles the side of a patch.
  int coarserLinks = 0;
  // Whether patches are also used at the first diffuse surface, where their errors directly affect the
  // answer.
  bool patchesAtFirst = false;
  Radiance ambientValue;  // -av
  bool spectral = false;  // a spectral run: light has bands
  uint64_t rotation = 0;  // changes the random numbers of patches
  double memory = 0;      // -Sm  MB for the irradiance cache; 0: no limit
};

}  // namespace rsphere
