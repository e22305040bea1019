#pragma once
// The CIE's observers, and conversions between spectra, tristimulus values and RADIANCE's red, green and blue.
//
// A spectrum is given by bins of equal width: values[0] is the mean from `first` (nm) on, the last value the
// mean up to `last` (nm); first may be above or below last. It is 0 beyond them.
//
// All integrals are normalized so that they are 1 for a spectrum that is 1 at all wavelengths.
// Source: CIE 15 (X, Y, Z of 1931, V'(lambda)), CIE S 026 (melanopic).
#include <span>

#include "base/color.h"
#include "base/spectral_sampling.h"

namespace rsphere {

struct Spectrum {
  std::span<const double> values;
  double first = 780, last = 380;  // nm
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

// Red, green and blue of RADIANCE's primaries (white 1/3, 1/3). Colors outside the gamut are mixed with just
// enough gray of the same Y that no channel is negative.
V3d standardRgb(const V3d& tristimulus);

}  // namespace rsphere
