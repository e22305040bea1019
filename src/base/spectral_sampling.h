#pragma once
// How a spectral run (-cs above 3) divides the spectrum into bands.
#include <Imath/ImathVec.h>

#include <array>
#include <span>
#include <vector>

#include "base/band_scheme.h"

namespace rsphere {

using Imath::V3d;

// The part of the spectrum that is computed (-cw), nm.
struct WavelengthLimits {
  double shortest = 380, longest = 780;
  bool operator==(const WavelengthLimits&) const = default;
};

// How the spectrum is divided into bands of equal width. Each band belongs to one channel: red, green or
// blue. The first band is that of the longest wavelengths.
struct SpectralSampling : BandScheme {
  double longest = 780, shortest = 380;    // nm, the limits (-cw)
  std::array<double, 2> splits{588, 480};  // nm, between red and green, and between green and blue
  std::vector<double> photopic;            // shares of the bands in the photopic integral

  double width() const { return (longest - shortest) / static_cast<double>(count()); }  // nm, of a band
};

// The largest number of bands that -cs accepts; more are reduced to it, as in rtrace as it is usually built.
inline constexpr int kMostBands = 24;

// The division of [shortest, longest] (nm) into bands. REQUIRES shortest < longest, 3 <= bands <= kMostBands.
// Equal arguments have the same result, which exists until the program ends. Thread-safe.
const SpectralSampling& spectralSampling(int bands, double shortest, double longest);

// Whether red, green and blue each have a part of the spectrum within these limits (nm): then the splits are
// RADIANCE's; otherwise they divide the range into thirds.
bool spectrumHoldsChannels(double shortest, double longest);

// The shares of bands in the integrals of the observers, as RADIANCE 6.1 computes them. Whatever is written
// is converted by these, so that it equals rtrace's output. RADIANCE's tables are displaced against the
// CIE's: light is seen as if its wavelength were 1.5 nm (X, Y, Z) or .5 nm (melanopic) longer, or .5 nm
// shorter (scotopic), and limits of bands are rounded down to whole nanometers. This changes X, Y and Z by 2
// to 4% for saturated colors, and by .3% for daylight.
struct BandWeights {
  std::vector<V3d> xyz;
  std::vector<double> scotopic, melanopic;

  V3d tristimulus(std::span<const double> bands) const;
};
BandWeights bandWeights(const SpectralSampling& sampling);

}  // namespace rsphere
