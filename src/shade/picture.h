#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/color.h"

namespace rsphere {

// A picture as patterns and mixtures use it: radiances over a rectangle whose shorter side is 1. Immutable.
class Picture {
 public:
  // Reads a RADIANCE picture: RGBE or XYZE, with new, old or no run-length coding, in any of the eight pixel
  // orders. Its exposure is not undone. Throws rad::Error, which begins with the path: Status::input if the
  // file is no such picture or is damaged, Status::system if it cannot be read.
  static Picture read(const std::string& path);

  size_t width() const { return width_; }
  size_t height() const { return height_; }

  // The colour at (x, y), interpolated linearly between pixels. The center of the lower left pixel is at (0,
  // 0), the centers of the other corner pixels are at the picture's size, and the shorter side, with regard
  // to PIXASPECT, is 1 (RADIANCE reference manual, "Colorpict"). Outside, the picture is extended like a data
  // file (rad::DataFile::value).
  Color value(double x, double y) const;

 private:
  struct Pixel {
    float r, g, b;
  };
  size_t width_ = 0, height_ = 0;
  double sizeX_ = 1, sizeY_ = 1;
  std::vector<Pixel> pixels_;  // the lowest row first, each from left to right
};

}  // namespace rsphere
