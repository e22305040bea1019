#pragma once
#include "base/radiometry.h"

namespace rsphere {

// How the fields of interpolated light are made, after rtrace's options.
struct FieldOptions {
  int bounces = 0;        // -ab
  double accuracy = .1;   // -aa
  int resolution = 256;   // -ar  0: no limit
  double rays = 1536;     // -ad + -as: the rays of patches are in proportion to it
  // Patches of the coarse solution that only others see are larger by so many levels, each of which doubles
  // their side.
  int coarserLinks = 0;
  // Whether patches serve the first diffuse surface too, so that their errors are those of the answer.
  bool patchesAtFirst = false;
  Radiance ambientValue;  // -av
  bool spectral = false;  // a spectral run: light has bands
  double memory = 0;      // -Sm  MB of the irradiance cache; 0: no bound
};

}  // namespace rsphere
