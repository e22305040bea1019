#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/observers.h"
#include "base/primaries.h"
#include "base/radiometry.h"
#include "base/spectral_sampling.h"
#include "records/record_text.h"

namespace rsphere {

enum class ColorSpace : uint8_t {
  rgb,
  xyz,        // -pXYZ  tristimulus values, Y in lumens
  primaries,  // -pc
  photopic,   // -pY -pS -pM: one channel, in lumens (-pM: scaled as in rtrace)
  scotopic,
  melanopic,
  edi,      // -pE  one channel, in lux
  average,  // -pA  one channel
  spectrum  // -co
};

// Options that determine how colors are computed and written.
struct ColorOptions {
  ColorSpace space = ColorSpace::rgb;
  Primaries primaries{};                 // -pc
  Receptor receptor{};                   // -pE
  int bands = 3;                         // -cs  3 to kMostBands
  double shortest = 380, longest = 780;  // -cw  nm

  // The division of the spectrum; null if the run has three channels. REQUIRES that checkColors() did not
  // throw.
  const SpectralSampling* sampling() const {
    return bands > 3 ? &spectralSampling(bands, shortest, longest) : nullptr;
  }
};

// Converts colors for output, according to -p.. and -co:
//   -pRGB        RADIANCE's red, green and blue
//   -pXYZ        CIE 1931, times 179 lm/W
//   -pc          RGB of other primaries: von Kries' adaptation to their white in the cone space of
//                the "sharp" transform; colors outside the gamut are mixed with gray until no channel
//                is negative
//   -pY -pS -pM  luminance (times 179 lm/W), scotopic luminance (412 lm/W), melanopic (179)
//   -pE          equivalent daylight illuminance (CIE S 026) for a receptor of the eye
//   -pA          the mean of all channels or bands
//   -co          the bands, if there are more than three (-cs)
// In a spectral run (-cs above 3), all of these are computed from the bands, as in rtrace; this includes
// colors without bands. In a run of three channels each channel represents a part of the spectrum: red from
// 588 nm up, green from 480 nm, blue below.
// Source: rtrace(1); G. Finlayson, S. Suesstrunk, "Spectral sharpening and the Bradford transform" (2000);
// CIE 15:2018 for X, Y, Z and V'(lambda), CIE S 026 for melanopic and EDI.
class OutputColors {
 public:
  explicit OutputColors(const ColorOptions& options);

  // The number of values in a color: 1, 3 or the number of bands.
  int count() const { return count_; }

  void write(RecordText& text, const Radiance& radiance) const { write(text, radiance.color, scale_); }
  void write(RecordText& text, const Irradiance& irradiance) const { write(text, irradiance.color, scale_); }
  // Writes without conversion to lumens.
  void write(RecordText& text, const Coefficient& coefficient) const { write(text, coefficient.color, 1); }

  // Writes a standard error: of each channel or band or, with -pY, of the brightness in lumens. REQUIRES:
  // haveStandardErrors().
  void writeError(RecordText& text, const Radiance& error, double brightness) const;

  // The header lines that describe the colors, with line ends; and the FORMAT of their pixels (-fc).
  std::string headerLines() const;
  std::string_view pixelFormat() const;

 private:
  void write(RecordText& text, const Color& color, double scale) const;
  void writeBands(RecordText& text, const Bands& bands, double scale) const;

  ColorOptions options_;
  const SpectralSampling* sampling_;
  int count_ = 3;
  double scale_ = 1;
  Color weights_{0, 0, 0};    // of the channels, if a color has one value
  M33d matrix_;               // if it has three: from RGB, or in a spectral run from X, Y and Z
  BandWeights bandWeights_;   // of a spectral run
  std::vector<double> seen_;  // -pE: of its bands
};

// Throws rad::Error with rtrace's text if the bands or limits are impossible, or if the primaries span no
// gamut.
void checkColors(const ColorOptions& options);

// Whether colors have standard errors (-oe): only unconverted channels or bands, and luminance. The error of
// any other sum cannot be computed from the errors of its terms.
bool haveStandardErrors(const ColorOptions& options);

// Whether all numbers of -pc are within .001 of RADIANCE's standard primaries and white.
bool areStandard(const Primaries& primaries);

}  // namespace rsphere
