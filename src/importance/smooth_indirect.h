#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// Indirect light on the surfaces that the pixels of a picture show, and the geometry of these surfaces.
struct IndirectPixels {
  struct Pixel {
    Imath::V3f light{0, 0, 0};  // reflected indirect light over the surface's pattern, W/sr/m2
    Imath::V3f point{0, 0, 0}, normal{0, 0, 0};
    float distance = 0;
    ModifierId material;  // kNone: the light is left as it is
  };
  int width = 0, height = 0;
  bool wraps = false;  // whether the first column continues the last
  std::vector<Pixel> pixels;
};

// Averages the light over nearby pixels that show the same material on the same flat or slightly curved
// surface. The few indirect rays of one pixel are noisy; a few hundred pixels reduce the noise to a
// sixteenth. Light that changes within 5 pixels is blurred. Edges of surfaces are not crossed. Source:
// Dammertz, Sewtz, Hanika, Lensch, "Edge-avoiding a-trous wavelet transform for fast global illumination
// filtering" (2010). Only geometry limits the filter here, because differences of light are noise.
void smoothIndirect(IndirectPixels& picture);

}  // namespace rsphere
