#include "base/observers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/cie_tables.h"

namespace rsphere {
namespace {

// The shift of RADIANCE's table relative to the CIE's (nm), as in BandWeights.
constexpr double kColorShift = 1.5;

// The cumulative integral of a curve, normalized to 1 at its longest wavelength. Between two values of the
// table the curve is constant at their mean.
class Cumulative {
 public:
  explicit Cumulative(const CieCurve& curve) : shortest_(curve.shortest), step_(curve.step), upTo_{0} {
    for (size_t i = 1; i < curve.values.size(); ++i)
      upTo_.push_back(upTo_.back() + (curve.values[i - 1] + curve.values[i]) / 2);
    for (double& share : upTo_) share /= upTo_.back();
  }

  double upTo(double wavelength) const {
    const double at = (wavelength - shortest_) / step_;
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
  double shortest_, step_;
  std::vector<double> upTo_;
};

// X, Y and Z.
struct ColorMatching {
  Cumulative x{colorMatchingX()}, y{colorMatchingY()}, z{colorMatchingZ()};
};
const ColorMatching& colorMatching() {
  static const ColorMatching curves;
  return curves;
}

}  // namespace

V3d tristimulus(const Spectrum& spectrum) {
  const auto& [x, y, z] = colorMatching();
  return V3d(x.of(spectrum), y.of(spectrum), z.of(spectrum));
}

double scotopic(const Spectrum& spectrum) {
  static const Cumulative curve(scotopicEfficiency());
  return curve.of(spectrum);
}

double melanopic(const Spectrum& spectrum) {
  static const Cumulative curve(melanopicSensitivity());
  return curve.of(spectrum);
}

double seenBy(Receptor receptor, const Spectrum& spectrum) {
  static const std::array<Cumulative, 3> cones{Cumulative(sConeSensitivity()), Cumulative(mConeSensitivity()),
                                               Cumulative(lConeSensitivity())};
  if (receptor == Receptor::rod) return scotopic(spectrum);
  if (receptor == Receptor::melanopsin) return melanopic(spectrum);
  return cones[static_cast<size_t>(receptor)].of(spectrum);
}

// The limits of bands are rounded down to whole nanometers. Before that, the ends of the spectrum are rounded
// to single precision; otherwise a rounding error could turn a limit of 500 nm, for example, into 499 nm.
V3d tristimulusInRadiance(const Spectrum& spectrum) {
  const size_t count = spectrum.values.size();
  const bool falls = spectrum.first > spectrum.last;
  const double shortest = static_cast<float>(std::min(spectrum.first, spectrum.last));
  const double longest = static_cast<float>(std::max(spectrum.first, spectrum.last));
  const double width = (longest - shortest) / static_cast<double>(count);
  const auto& [x, y, z] = colorMatching();
  const auto upTo = [&, &x = x, &y = y, &z = z](size_t fromShortest) {
    const double limit = std::floor(shortest + static_cast<double>(fromShortest) * width) + kColorShift;
    return V3d(x.upTo(limit), y.upTo(limit), z.upTo(limit));
  };
  V3d sum(0, 0, 0), from = upTo(0);
  for (size_t i = 0; i < count; ++i) {
    const V3d to = upTo(i + 1);
    sum += spectrum.values[falls ? count - 1 - i : i] * (to - from);
    from = to;
  }
  return sum;
}

}  // namespace rsphere
