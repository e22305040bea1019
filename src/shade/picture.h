#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/rgb.h"

namespace rsphere {

// A picture as patterns and mixtures use it: radiances over the unit square, or what the longer side makes of
// it. Immutable.
class Picture {
 public:
  // Reads a RADIANCE picture: run-length coded RGBE or XYZE, new or old code or none, in any of the eight
  // orders of pixels. Its exposure is not undone. Throws rad::Error that begins with the path: no such
  // picture, or a damaged one (Status::input); no readable file (Status::system).
  static Picture read(const std::string& path);

  size_t width() const { return width_; }
  size_t height() const { return height_; }

  // The colour at (x, y): the middles of the corner pixels are at 0 and at the picture's size, the lower left
  // one at (0, 0); its shorter side is 1 long (RADIANCE reference manual, "Colorpict"; PIXASPECT counts).
  // Linear between pixels; beyond them as data files are (rad::DataFile::value).
  Rgb value(double x, double y) const;

 private:
  struct Pixel {
    float r, g, b;
  };
  size_t width_ = 0, height_ = 0;
  double sizeX_ = 1, sizeY_ = 1;
  std::vector<Pixel> pixels_;  // the lowest row first, from left to right
};

}  // namespace rsphere
