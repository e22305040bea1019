#include "base/spectral_sampling.h"

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "base/observers.h"

namespace rsphere {
namespace {

// Wavelengths (nm), as in RADIANCE: limits between red, green and blue, and peaks of the red and blue
// responses.
constexpr double kRedFrom = 588, kGreenFrom = 480;
constexpr double kRedPeak = 607, kBluePeak = 469;

// Shifts of wavelengths in RADIANCE's tables relative to the CIE's (nm). Found by comparing rtrace's output
// for narrow bands with the CIE's curves.
constexpr double kScotopicShift = -.5, kMelanopicShift = .5;

SpectralSampling makeSampling(int bands, double shortest, double longest) {
  SpectralSampling s;
  s.longest = longest;
  s.shortest = shortest;
  const double third = (longest - shortest) / 3;
  s.splits = spectrumHoldsChannels(shortest, longest) ? std::array{kRedFrom, kGreenFrom}
                                                      : std::array{longest - third, longest - 2 * third};
  const double width = (longest - shortest) / bands;
  for (int i = 0; i < bands; ++i) {
    const double middle = longest - (i + .5) * width;
    s.channel.push_back(middle >= s.splits[0] ? 0 : middle >= s.splits[1] ? 1 : 2);
  }
  for (const V3d& weight : bandWeights(s).xyz) s.photopic.push_back(weight.y);
  return s;
}

}  // namespace

bool spectrumHoldsChannels(double shortest, double longest) {
  return shortest < kBluePeak && longest > kRedPeak;
}

V3d BandWeights::tristimulus(std::span<const double> bands) const {
  V3d sum(0, 0, 0);
  for (size_t i = 0; i < bands.size(); ++i) sum += bands[i] * xyz[i];
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

const SpectralSampling& spectralSampling(int bands, double shortest, double longest) {
  // Never destroyed: colors of static objects may outlive any object of this function.
  static std::mutex& mutex = *new std::mutex;
  static auto& all = *new std::map<std::tuple<int, double, double>, std::unique_ptr<SpectralSampling>>;
  const std::lock_guard lock(mutex);
  auto& made = all[{bands, shortest, longest}];
  if (!made) made = std::make_unique<SpectralSampling>(makeSampling(bands, shortest, longest));
  return *made;
}

}  // namespace rsphere
