#include "base/colorimetry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/primaries.h"

namespace rsphere {

Spectrum spectrumOf(const Bands& bands) {
  return {bands.values(), bands.sampling().longest, bands.sampling().shortest};
}

Bands bandsOf(const Spectrum& spectrum, const SpectralSampling& sampling) {
  Bands bands(sampling);
  const std::span<double> means = bands.values();
  const size_t count = spectrum.values.size();
  const bool falls = spectrum.first > spectrum.last;
  const double longest = std::max(spectrum.first, spectrum.last);
  const double step = std::abs(spectrum.last - spectrum.first) / static_cast<double>(count);
  const double width = sampling.width();
  // Positions are distances (nm) from the longest wavelength of the bands. In this order, both the values of
  // the spectrum and the bands ascend.
  const double offset = sampling.longest - longest;
  for (size_t i = 0; i < count; ++i) {
    const double value = spectrum.values[falls ? i : count - 1 - i];
    const double from = std::max(0., offset + static_cast<double>(i) * step);
    const double to =
        std::min(sampling.longest - sampling.shortest, offset + static_cast<double>(i + 1) * step);
    if (!(from < to)) continue;
    for (auto band = static_cast<size_t>(from / width); band < means.size(); ++band) {
      const double begin = static_cast<double>(band) * width;
      const double overlap = std::min(to, begin + width) - std::max(from, begin);
      if (overlap > 0) means[band] += value * overlap / width;
      if (begin + width >= to) break;
    }
  }
  return bands;
}

// The mean of a linear curve over an interval is its value at the middle.
Bands bandsOf(const SpectralCurve& curve, const SpectralSampling& sampling) {
  Bands bands(sampling);
  const std::span<double> means = bands.values();
  const double width = sampling.width();
  const auto [wavelengths, values] = curve;
  for (size_t i = 1; i < values.size(); ++i) {
    const double from = std::max(std::min(wavelengths[i - 1], wavelengths[i]), sampling.shortest);
    const double to = std::min(std::max(wavelengths[i - 1], wavelengths[i]), sampling.longest);
    if (!(from < to)) continue;
    const double slope = (values[i] - values[i - 1]) / (wavelengths[i] - wavelengths[i - 1]);
    for (auto band = static_cast<size_t>((sampling.longest - to) / width); band < means.size(); ++band) {
      const double end = sampling.longest - static_cast<double>(band) * width;
      const double high = std::min(to, end), low = std::max(from, end - width);
      if (low < high)
        means[band] +=
            (values[i - 1] + slope * ((low + high) / 2 - wavelengths[i - 1])) * (high - low) / width;
      if (end - width <= from) break;
    }
  }
  return bands;
}

V3d standardRgb(const V3d& xyz) {
  static const M33d rgbFromXyz = xyzFromRgb(kStandardPrimaries).inverse();
  return intoGamut(xyz * rgbFromXyz, xyz.y);
}

double photopicOf(const Color& color, const SpectralSampling* sampling) {
  if (!sampling) return brightness(color);
  const Bands bands = color.bandsIn(*sampling);
  return std::inner_product(bands.values().begin(), bands.values().end(), sampling->photopic.begin(), 0.);
}

V3d shownRgb(const Color& color, const SpectralSampling* sampling) {
  if (!sampling) return color.rgb();
  static thread_local const SpectralSampling* last = nullptr;
  static thread_local BandWeights weights;
  if (last != sampling) weights = bandWeights(*sampling);
  last = sampling;
  return standardRgb(weights.tristimulus(color.bandsIn(*sampling).values()));
}

}  // namespace rsphere
