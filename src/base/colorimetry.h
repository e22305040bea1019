#pragma once
// The CIE's observers, and conversions between spectra, tristimulus values and RADIANCE's red, green and blue.
//
// A spectrum is given by bins of equal width: values[0] is the mean from `first` (nm) on, the last value the
// mean up to `last` (nm); first may be above or below last. It is 0 beyond them.
//
// All integrals are normalized so that they are 1 for a spectrum that is 1 at all wavelengths.
// Source: CIE 15 (X, Y, Z of 1931, V'(lambda)), CIE S 026 (melanopic).
#include <span>
#include <vector>

#include "base/color.h"
#include "base/spectral_sampling.h"

namespace rsphere {

struct Spectrum {
  std::span<const double> values;
  double first = 780, last = 380;  // nm
};

// A spectrum given at single wavelengths (nm, strictly rising or falling, at least two): linear between them, 0 beyond.
struct SpectralCurve {
  std::span<const double> wavelengths, values;  // of the same length
};

// X, Y, Z, photopic (= Y), scotopic and melanopic integrals.
V3d tristimulus(const Spectrum& spectrum);
double photopic(const Spectrum& spectrum);
double scotopic(const Spectrum& spectrum);
double melanopic(const Spectrum& spectrum);

// The spectrum of bands.
Spectrum spectrumOf(const Bands& bands);
// The means of a spectrum in each band.
Bands bandsOf(const Spectrum& spectrum, const SpectralSampling& sampling);
Bands bandsOf(const SpectralCurve& curve, const SpectralSampling& sampling);

// Red, green and blue of RADIANCE's primaries (white 1/3, 1/3). Colors outside the gamut are mixed with just
// enough gray of the same Y that no channel is negative.
V3d standardRgb(const V3d& tristimulus);

// X, Y, Z as RADIANCE 6.1 has them, with limits of bins rounded down to whole nanometers: see BandWeights.
V3d tristimulusInRadiance(const Spectrum& spectrum);

// The shares of bands in the integrals of the observers as RADIANCE 6.1 has them, by which all is written, so that
// it is the same as rtrace's. Their tables are displaced against the CIE's: light is seen as if its wavelength were
// 1.5 nm (X, Y, Z) or .5 nm (melanopic) longer, or .5 nm shorter (scotopic), and limits of bands are rounded down to
// whole nanometers. In X, Y and Z of saturated colors this makes 2 to 4%, in those of daylight .3%.
struct BandWeights {
  std::vector<V3d> xyz;
  std::vector<double> scotopic, melanopic;

  V3d tristimulus(const Bands& bands) const;
};
BandWeights bandWeights(const SpectralSampling& sampling);

// Red, green and blue of a color: its channels, or standardRgb() of its bands in a spectral run (sampling: not
// null), by bandWeights().
V3d shownRgb(const Color& color, const SpectralSampling* sampling);

}  // namespace rsphere
