#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// The surface that a pixel shows.
struct SeenSurface {
  ModifierId material;  // kNone: the pixel shares no light with others
  Imath::V3f point{0, 0, 0}, normal{0, 0, 0};
  float distance = 0;   // from the eye
  int panes = 0;        // of glass in front of it
  uint32_t images = 0;  // if it is a mirror: which surfaces it shows, as a hash
  float roughness = 0;  // of its gloss
};

struct SeenSurfaces {
  int width = 0, height = 0;
  bool wraps = false;  // whether the first column continues the last
  std::vector<SeenSurface> pixels;
};

// One component of the light of all pixels.
struct PixelLight {
  std::vector<Imath::V3f> light;
  std::vector<float> known;  // fraction of the surrounding pixels with sampled light; 0: light is undefined
};

struct Smoothing {
  int passes = 0;        // each with twice the reach of the preceding one
  int careful = 0;       // number of further passes, in which pixels share light only if it differs little
  float sameLight = 0;   // largest relative difference: tuning::Pictures::kSameLight
  float sameNormal = 0;  // least cosine between the normals
  float near = 0;        // tuning::Pictures::kNear
  bool ofGloss = false;  // whether the normals may differ more where surfaces are rougher
};

// Whether two pixels show one material on a common flat or slightly curved surface.
bool mayShare(const SeenSurface& a, const SeenSurface& b, const Smoothing& smoothing);

// Averages the light over nearby pixels that may share it. Pixels without sampled light get the light of
// their neighbors; if these have none either, `known` stays 0. Averages do not cross edges of surfaces. Three
// passes, with steps of 1, 2 and 4 pixels, act like a Gaussian with a standard deviation of 4.6 pixels: they
// blur finer variation, and reduce noise to a sixteenth. Of the remaining differences, small ones are mostly
// noise and large ones shadows; careful passes blur only small ones. Source: Dammertz, Sewtz, Hanika, Lensch,
// "Edge-avoiding a-trous wavelet transform for fast global illumination filtering" (2010).
void smoothLight(const SeenSurfaces& seen, const Smoothing& smoothing, PixelLight& light);

}  // namespace rsphere
