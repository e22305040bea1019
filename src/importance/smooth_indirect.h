#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// Indirect light on what the pixels of a picture show, and what tells which pixels may share it.
struct IndirectPixels {
  struct Pixel {
    Imath::V3f light{0, 0, 0};  // indirect light that is sent here, over what the pattern lets pass of it
    Imath::V3f point{0, 0, 0}, normal{0, 0, 0};
    float distance = 0;
    int32_t material = kNone;  // none: the light stays as it is
  };
  int width = 0, height = 0;
  bool wraps = false;  // whether the last column lies beside the first
  std::vector<Pixel> pixels;
};

// Averages the light over pixels nearby that show the same material on the same even or slightly curved
// surface: a pixel's own few indirect rays are noise, a few hundred pixels together tell the light to a
// sixteenth of it. Light that changes within 5 pixels is blurred; edges of surfaces are not crossed.
// Source: Dammertz, Sewtz, Hanika, Lensch, "Edge-avoiding a-trous wavelet transform for fast global
// illumination filtering" (2010), with geometry alone to stop it, as the light's own differences are noise.
void smoothIndirect(IndirectPixels& picture);

}  // namespace rsphere
