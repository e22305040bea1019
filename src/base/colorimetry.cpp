#include "base/colorimetry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/cie_tables.h"
#include "base/primaries.h"

namespace rsphere {
namespace {

// The integral of a curve from its shortest wavelength on, 1 at its longest. Between the values of the table, which
// are 1 nm apart, the integral is interpolated linearly: the curve is constant there, at the mean of both.
class Cumulative {
 public:
  explicit Cumulative(const CieCurve& curve) : shortest_(curve.shortest), upTo_{0} {
    for (size_t i = 1; i < curve.values.size(); ++i)
      upTo_.push_back(upTo_.back() + (curve.values[i - 1] + curve.values[i]) / 2);
    for (double& share : upTo_) share /= upTo_.back();
  }

  double upTo(double wavelength) const {
    const double at = wavelength - shortest_;
    if (!(at > 0)) return 0;
    const auto i = static_cast<size_t>(std::min(at, static_cast<double>(upTo_.size())));
    if (i + 1 >= upTo_.size()) return 1;
    return std::lerp(upTo_[i], upTo_[i + 1], at - static_cast<double>(i));
  }

  double of(const Spectrum& s) const {
    const double step = (s.last - s.first) / static_cast<double>(s.values.size());
    double sum = 0, from = upTo(s.first);
    for (size_t i = 0; i < s.values.size(); ++i) {
      const double to = upTo(s.first + static_cast<double>(i + 1) * step);
      sum += s.values[i] * (to - from);
      from = to;
    }
    return step < 0 ? -sum : sum;
  }

 private:
  double shortest_;
  std::vector<double> upTo_;
};

const Cumulative& cumulativeX() {
  static const Cumulative curve(colorMatchingX());
  return curve;
}
const Cumulative& cumulativeY() {
  static const Cumulative curve(colorMatchingY());
  return curve;
}
const Cumulative& cumulativeZ() {
  static const Cumulative curve(colorMatchingZ());
  return curve;
}

}  // namespace

V3d tristimulus(const Spectrum& spectrum) {
  return V3d(cumulativeX().of(spectrum), cumulativeY().of(spectrum), cumulativeZ().of(spectrum));
}

double photopic(const Spectrum& spectrum) { return cumulativeY().of(spectrum); }

double scotopic(const Spectrum& spectrum) {
  static const Cumulative curve(scotopicEfficiency());
  return curve.of(spectrum);
}

double melanopic(const Spectrum& spectrum) {
  static const Cumulative curve(melanopicSensitivity());
  return curve.of(spectrum);
}

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
  // Positions are distances (nm) from the longest wavelength of the bands, in which both sequences rise.
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

// A linear curve has its mean over an interval in the middle of it.
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
  static const Matrix rgbFromXyz = inverse(xyzFromRgb(kStandardPrimaries));
  return intoGamut(product(rgbFromXyz, xyz), xyz.y);
}

V3d BandWeights::tristimulus(const Bands& bands) const {
  const std::span<const double> values = bands.values();
  V3d sum(0, 0, 0);
  for (size_t i = 0; i < values.size(); ++i) sum += values[i] * xyz[i];
  return sum;
}

// How much longer the wavelength of light seems to be by RADIANCE's tables (nm): found by comparing what rtrace writes for
// narrow bands with the CIE's curves.
constexpr double kColorShift = 1.5, kScotopicShift = -.5, kMelanopicShift = .5;

// The ends of the spectrum are rounded to single precision, so that rounding errors do not move a limit at a
// whole number to the number below.
V3d tristimulusInRadiance(const Spectrum& spectrum) {
  const size_t count = spectrum.values.size();
  const bool falls = spectrum.first > spectrum.last;
  const double shortest = static_cast<float>(std::min(spectrum.first, spectrum.last));
  const double longest = static_cast<float>(std::max(spectrum.first, spectrum.last));
  const double width = (longest - shortest) / static_cast<double>(count);
  const auto upTo = [&](size_t fromShortest) {
    const double limit = std::floor(shortest + static_cast<double>(fromShortest) * width) + kColorShift;
    return V3d(cumulativeX().upTo(limit), cumulativeY().upTo(limit), cumulativeZ().upTo(limit));
  };
  V3d sum(0, 0, 0), from = upTo(0);
  for (size_t i = 0; i < count; ++i) {
    const V3d to = upTo(i + 1);
    sum += spectrum.values[falls ? count - 1 - i : i] * (to - from);
    from = to;
  }
  return sum;
}

BandWeights bandWeights(const SpectralSampling& sampling) {
  BandWeights weights;
  const size_t count = sampling.count();
  const auto limit = [&](size_t fromShortest) {
    return std::floor(sampling.shortest + static_cast<double>(fromShortest) * sampling.width());
  };
  for (size_t i = 0; i < count; ++i) {
    const double longer = limit(count - i), shorter = limit(count - i - 1);
    static constexpr std::array<double, 1> kOne{1};
    const auto seen = [&](double displacement) {
      return Spectrum{kOne, longer + displacement, shorter + displacement};
    };
    weights.xyz.push_back(tristimulusInRadiance({kOne, longer, shorter}));
    weights.scotopic.push_back(scotopic(seen(kScotopicShift)));
    weights.melanopic.push_back(melanopic(seen(kMelanopicShift)));
  }
  return weights;
}

V3d shownRgb(const Color& color, const SpectralSampling* sampling) {
  if (!sampling) return color.rgb();
  static thread_local const SpectralSampling* last = nullptr;
  static thread_local BandWeights weights;
  if (last != sampling) weights = bandWeights(*sampling);
  last = sampling;
  return standardRgb(weights.tristimulus(color.bandsIn(*sampling)));
}

}  // namespace rsphere
