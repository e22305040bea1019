#include "base/spectral_sampling.h"

#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <tuple>

#include "base/colorimetry.h"

namespace rsphere {
namespace {

// Wavelengths (nm) of the limits between red, green and blue, and of the peaks of the outer channels'
// responses, as in RADIANCE.
constexpr double kRedFrom = 588, kGreenFrom = 480;
constexpr double kRedPeak = 607, kBluePeak = 469;

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

double photopicOf(const Color& color, const SpectralSampling* sampling) {
  if (!sampling) return brightness(color);
  const Bands bands = color.bandsIn(*sampling);
  return std::inner_product(bands.values().begin(), bands.values().end(), sampling->photopic.begin(), 0.);
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
