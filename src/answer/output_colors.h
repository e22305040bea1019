#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "answer/record_text.h"
#include "base/radiometry.h"
#include "base/spectral_sampling.h"

namespace rsphere {

enum class ColorSpace : uint8_t {
  rgb,
  xyz,        // -pXYZ  tristimulus values, Y in lumens
  primaries,  // -pc
  photopic,   // -pY -pS -pM: one channel, in lumens (-pM: as rtrace scales it)
  scotopic,
  melanopic,
  average,  // -pA  one channel
  spectrum  // -co
};

// The options that choose how colors are written.
struct ColorOptions {
  ColorSpace space = ColorSpace::rgb;
  std::array<double, 8> primaries{};     // x y of red, green, blue and white
  int bands = 3;                         // -cs  3 to kMostBands
  double shortest = 380, longest = 780;  // -cw  nm
};

// Converts red, green and blue to the colors that -p.., -cs, -cw and -co ask for. Scenes have three channels,
// each of which represents a part of the spectrum: red from 588 nm up, green from 480 nm, blue below.
//   -pXYZ        CIE 1931, times 179 lm/W
//   -pc          RGB of other primaries: von Kries' adaptation to their white between the cones of
//                the "sharp" transform, and colors outside the gamut mixed with grey
//                until no channel is negative
//   -pY -pS -pM  luminance (times 179 lm/W), scotopic luminance (412 lm/W), melanopic (179)
//   -pA          the mean of the channels
//   -co          with more than three bands (-cs): each band has the value of its channel
// Source: rtrace(1); G. Finlayson, S. Suesstrunk, "Spectral sharpening and the Bradford transform" (2000);
// CIE 15:2018 for X, Y, Z and V'(lambda), CIE S 026 for melanopic.
class OutputColors {
 public:
  explicit OutputColors(const ColorOptions& options);

  // The number of numbers in a color: 1, 3 or the number of bands.
  int count() const { return count_; }

  void write(RecordText& text, const Radiance& radiance) const { write(text, radiance.color, scale_); }
  void write(RecordText& text, const Irradiance& irradiance) const { write(text, irradiance.color, scale_); }
  // Without the conversion to lumens.
  void write(RecordText& text, const Coefficient& coefficient) const { write(text, coefficient.color, 1); }

  // Writes a standard error: that of red, green and blue, or under -pY that of brightness, in lumens.
  // REQUIRES: colors are RGB or -pY. The errors of other sums of the channels cannot be computed from these.
  void writeError(RecordText& text, const Radiance& channels, double brightness) const {
    if (options_.space == ColorSpace::photopic) return text.number(scale_ * brightness);
    text.color(channels.color);
  }

  // The lines of the header that describe the colors, with line ends, and the FORMAT of their pixels (-fc).
  std::string headerLines() const;
  std::string_view pixelFormat() const;

 private:
  using Matrix = std::array<std::array<double, 3>, 3>;
  void write(RecordText& text, const Color& color, double scale) const;

  ColorOptions options_;
  int count_ = 3;
  double scale_ = 1;
  Color weights_{0, 0, 0};    // if a color is one number
  Matrix fromRgb_{};          // if it is three
  std::vector<int> channel_;  // if it is bands: the channel of each, from the longest wavelength
};

// Throws rad::Error with rtrace's words if the bands or limits are impossible, or if
// the primaries span no gamut.
void checkColors(const ColorOptions& options);

// Whether every channel has a part of the spectrum within its limits. rtrace warns if this is not so.
bool spectrumHoldsChannels(const ColorOptions& options);

// Whether all of -pc's numbers are within .001 of RADIANCE's standard primaries and white.
bool areStandard(const std::array<double, 8>& primaries);

}  // namespace rsphere
