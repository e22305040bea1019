#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/color.h"

namespace rsphere {

// A pixel in RADIANCE's format: three mantissas and a shared exponent.
using Rgbe = std::array<uint8_t, 4>;

// Size of a picture with the shorter side 1, considering PIXASPECT.
struct PictureSize {
  double x = 1, y = 1;
};

// A picture for patterns and mixtures: radiances over a rectangle whose shorter side is 1. Immutable.
class Picture {
 public:
  // Reads a RADIANCE picture: RGBE with new, old or no run-length coding, in any of the eight pixel orders,
  // up to 65536 rows and columns. The exposure is not undone. XYZE is rejected, as by rtrace. Throws
  // rad::Error, which begins with the path: Status::input if the file is damaged or of another kind,
  // Status::system if it cannot be read.
  static Picture read(const std::string& path);

  size_t width() const { return width_; }
  size_t height() const { return height_; }

  // The color at (x, y), interpolated linearly between pixels. The center of the lower left pixel is at (0,
  // 0), and the opposite corner pixel at the size of the picture. The shorter side, considering PIXASPECT, is
  // 1 (RADIANCE reference manual, "Colorpict"). Outside, the picture is extended like a data file
  // (rad::DataFile::value).
  Color value(double x, double y) const;

 private:
  size_t width_ = 0, height_ = 0;
  PictureSize size_;
  std::vector<Rgbe> pixels_;  // the lowest row first, each from left to right
};

// A picture with a spectrum in each pixel, for specpict. Immutable.
class SpectralPicture {
 public:
  // Reads a picture as written by rtrace -co: with FORMAT=Radiance_spectra, NCOMP and WAVELENGTH_SPLITS in
  // its header, and mantissas with a shared exponent, without run-length coding, in the order -Y +X. Other
  // orders are rejected, as by rtrace. The exposure is not undone. Throws like Picture::read().
  static SpectralPicture read(const std::string& path);

  size_t width() const { return width_; }
  size_t height() const { return height_; }
  // Number of bins of each spectrum, and the wavelengths (nm) of the beginning of the first and the end of
  // the last bin.
  size_t components() const { return components_; }
  double first() const { return first_; }
  double last() const { return last_; }

  // The spectrum at (x, y), by the rules of Picture::value(). REQUIRES room for components() values.
  void value(double x, double y, std::span<double> spectrum) const;

 private:
  size_t width_ = 0, height_ = 0;
  PictureSize size_;
  size_t components_ = 0;
  double first_ = 0, last_ = 0;
  std::vector<uint8_t> pixels_;  // components and exponent, as in the file; in the order of Picture::pixels_
};

}  // namespace rsphere
