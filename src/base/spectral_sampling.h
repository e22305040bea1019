#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/color.h"

namespace rsphere {

// What is computed of the spectrum (-cw), nm.
struct WavelengthLimits {
  double shortest = 380, longest = 780;
};

// How the spectrum is divided: into bands of equal width, of which each is also a part of one channel.
struct SpectralSampling {
  double longest = 780, shortest = 380;    // nm, the limits (-cw)
  std::array<double, 2> splits{588, 480};  // nm, between red and green, and between green and blue
  std::vector<uint8_t> channel;  // of each band, from the longest wavelength: 0 red, 1 green, 2 blue

  std::vector<double> photopic;  // shares of the bands in the photopic integral (colorimetry.h)

  size_t count() const { return channel.size(); }
  double width() const { return (longest - shortest) / static_cast<double>(count()); }  // nm, of a band
};

// The largest number of bands that -cs accepts; more are reduced to it, as in rtrace as it is usually built.
inline constexpr int kMostBands = 24;

// The division of [shortest, longest] (nm) into bands. REQUIRES shortest < longest, 3 <= bands <= kMostBands.
// Equal arguments have the same result, which exists until the program ends. Thread-safe.
const SpectralSampling& spectralSampling(int bands, double shortest, double longest);

// The brightness of a color, and in a spectral run (sampling: not null) its photopic integral.
double photopicOf(const Color& color, const SpectralSampling* sampling);

// Whether red, green and blue each have a part of the spectrum within these limits (nm): then the splits are
// RADIANCE's; otherwise they divide the range into thirds.
bool spectrumHoldsChannels(double shortest, double longest);

}  // namespace rsphere
