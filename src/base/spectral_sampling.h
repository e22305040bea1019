#pragma once
// Division of the spectrum into bands in a spectral run (-cs above 3).
#include <Imath/ImathVec.h>

#include <array>
#include <span>
#include <vector>

#include "base/band_scheme.h"

namespace rsphere {

using Imath::V3d;

// The computed part of the spectrum (-cw), nm.
struct WavelengthLimits {
  double shortest = 380, longest = 780;
  bool operator==(const WavelengthLimits&) const = default;
};

// Division of the spectrum into bands of equal width, beginning with the longest wavelengths. Each band
// belongs to one channel: red, green or blue.
struct SpectralSampling : BandScheme {
  double longest = 780, shortest = 380;    // nm, the limits (-cw)
  std::array<double, 2> splits{588, 480};  // nm, between red and green, and between green and blue
  std::vector<double> photopic;            // weights of the bands in the photopic integral

  double width() const { return (longest - shortest) / static_cast<double>(count()); }  // nm, of a band
};

// The largest number of bands. If -cs is larger it is reduced to this, as in usual builds of rtrace.
inline constexpr int kMostBands = 24;

// The division of [shortest, longest] (nm) into bands. REQUIRES shortest < longest, 3 <= bands <= kMostBands.
// Equal arguments have the same result, which exists until the program ends. Thread-safe.
const SpectralSampling& spectralSampling(int bands, double shortest, double longest);

// Whether red, green and blue each have a part of the spectrum within these limits (nm). If so, the splits
// are RADIANCE's; otherwise they divide the range into thirds.
bool spectrumHoldsChannels(double shortest, double longest);

// Weights of bands in the integrals of the observers, as computed by RADIANCE 6.1. All output is converted
// with these weights, so that it equals rtrace's. RADIANCE's tables are shifted relative to the CIE's, as if
// the wavelengths of light were 1.5 nm (X, Y, Z) or .5 nm (melanopic) longer, or .5 nm shorter (scotopic),
// and limits of bands are rounded down to whole nanometers. This changes X, Y and Z by 2 to 4% for saturated
// colors, and by .3% for daylight.
struct BandWeights {
  std::vector<V3d> xyz;
  std::vector<double> scotopic, melanopic;

  V3d tristimulus(std::span<const double> bands) const;
};
BandWeights bandWeights(const SpectralSampling& sampling);

}  // namespace rsphere
