#include "importance/clamp.h"

#include <algorithm>

namespace rsphere {

Irradiance clampContributions(std::span<DirectionSample> samples, std::span<const Radiance> guesses,
                              const Irradiance& total, double share, const SpectralSampling* sampling) {
  const auto guessOf = [&](size_t i) { return guesses.empty() ? Radiance() : guesses[i]; };
  const auto beyondGuess = [&](size_t i) {
    return photopicOf(irradianceFrom(samples[i].value - guessOf(i), samples[i].solidAngle).color, sampling);
  };
  const double all = photopicOf(total.color, sampling);
  double excess = 0;
  for (size_t i = 0; i < samples.size(); ++i) excess += std::max(0., beyondGuess(i) - share * all);
  const double limit = share * (all - excess);
  Irradiance taken;
  if (!(limit > 0)) return taken;
  for (size_t i = 0; i < samples.size(); ++i) {
    const double contribution = beyondGuess(i);
    if (contribution <= limit) continue;
    const Radiance before = samples[i].value;
    samples[i].value = guessOf(i) + (before - guessOf(i)) * (limit / contribution);
    taken += irradianceFrom(before - samples[i].value, samples[i].solidAngle);
  }
  return taken;
}

}  // namespace rsphere
