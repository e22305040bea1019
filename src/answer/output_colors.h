#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "answer/record_text.h"
#include "base/rgb.h"

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

// How colors are written.
struct ColorOptions {
  ColorSpace space = ColorSpace::rgb;
  std::array<double, 8> primaries{};     // x y of red, green, blue and white
  int bands = 3;                         // -cs  at most kMostBands count
  double shortest = 380, longest = 780;  // -cw  nm
};
inline constexpr int kMostBands = 24;

// What -p.. -cs -cw -co make of red, green and blue. Scenes have three channels; each stands for a part of
// the spectrum: red from 588 nm up, green from 480 nm, blue below.
//   -pXYZ        CIE 1931, times 179 lm/W
//   -pc          RGB of other primaries: von Kries' adaptation to their white between the cones of
//                the "sharp" transform, and colors outside the gamut mixed with grey until no
//                channel is negative
//   -pY -pS -pM  luminance (times 179 lm/W), scotopic luminance (412 lm/W), melanopic (179)
//   -pA          the mean of the channels
//   -co          with more than three bands (-cs): each band has the value of its channel
// Source: rtrace(1); G. Finlayson, S. Suesstrunk, "Spectral sharpening and the Bradford transform" (2000);
// CIE 15:2018 for X, Y, Z and V'(lambda), CIE S 026 for melanopic.
class OutputColors {
 public:
  explicit OutputColors(const ColorOptions& options);

  // Numbers a color takes: 1, 3 or the bands.
  int count() const { return count_; }

  void write(RecordText& text, const Rgb& radiance) const { write(text, radiance, scale_); }
  // A coefficient: as a color, but for the lumens.
  void writeCoefficient(RecordText& text, const Rgb& coefficient) const { write(text, coefficient, 1); }

  // A standard error: of red, green and blue as they are, or under -pY that of brightness, in lumens.
  // REQUIRES one of the two: the errors of other sums of the channels follow from neither.
  void writeError(RecordText& text, const Rgb& channels, double brightness) const {
    if (options_.space == ColorSpace::photopic) return text.number(scale_ * brightness);
    text.color(channels);
  }

  // The lines of the header that tell of it, with line ends; and FORMAT of its pixels (-fc).
  std::string headerLines() const;
  std::string_view pixelFormat() const;

 private:
  using Matrix = std::array<std::array<double, 3>, 3>;
  void write(RecordText& text, const Rgb& color, double scale) const;

  ColorOptions options_;
  int count_ = 3;
  double scale_ = 1;
  Rgb weights_{0, 0, 0};      // of one channel
  Matrix fromRgb_{};          // of three
  std::vector<int> channel_;  // of each band, from the longest wavelength
};

// Throws rad::Error, as rtrace words it: bands or limits that cannot be, primaries that span no gamut.
// Whether the limits of the spectrum leave each channel its place: if not, rtrace warns of it.
void checkColors(const ColorOptions& options);
bool spectrumHoldsChannels(const ColorOptions& options);

// Whether all of -pc's numbers are within .001 of RADIANCE's standard primaries and white.
bool areStandard(const std::array<double, 8>& primaries);

}  // namespace rsphere
