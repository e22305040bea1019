#pragma once
// Conversions between spectra, bands, tristimulus values and RADIANCE's red, green and blue.
#include <span>

#include "base/color.h"
#include "base/observers.h"
#include "base/spectral_sampling.h"

namespace rsphere {

// A spectrum given at wavelengths (nm; at least two, in ascending or descending order): linear between them,
// 0 outside.
struct SpectralCurve {
  std::span<const double> wavelengths, values;  // of the same length
};

// The spectrum that a color's bands represent.
Spectrum spectrumOf(const Bands& bands);
// The means of a spectrum in each band.
Bands bandsOf(const Spectrum& spectrum, const SpectralSampling& sampling);
Bands bandsOf(const SpectralCurve& curve, const SpectralSampling& sampling);

// Red, green and blue for RADIANCE's primaries (white 1/3, 1/3). Colors outside the gamut are mixed with gray
// of the same Y until no channel is negative.
V3d standardRgb(const V3d& tristimulus);

// The brightness of a color. In a spectral run (sampling not null), its photopic integral instead.
double photopicOf(const Color& color, const SpectralSampling* sampling);

// Red, green and blue of a color: its channels or, in a spectral run (sampling not null), standardRgb() of
// its bands, converted by bandWeights().
V3d shownRgb(const Color& color, const SpectralSampling* sampling);

}  // namespace rsphere
