#pragma once
#include <vector>

namespace rsphere {

// Red, green and blue of each pixel (W/sr/m2, or screen colours from 0 to 1), beginning with the highest row.
struct Raster {
  int width = 0, height = 0;
  std::vector<float> pixels;
};

}  // namespace rsphere
