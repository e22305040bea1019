#include "silhouettes/source_variance.h"

#include <algorithm>
#include <vector>

#include "points/tuning.h"

namespace rsphere {

Variance partsVariance(std::span<const SeenSources::Sample> samples, const SpectralSampling* sampling,
                       KernelVariances* to) {
  // The samples are ordered by rows of the grid. A pair is two neighbours in a row, or in adjacent rows if
  // these are as long as the first row.
  Variance sum, edges;
  size_t pairs = 0;
  for (const auto& s : samples) {
    const double clear = static_cast<double>(s.clear) / s.aimed;
    edges += Variance::of(irradianceFrom(s.direction.value, s.part), sampling) *
             (tuning::ErrorEstimate::kEvenParts * clear * (1 - clear) / s.aimed);
  }
  const size_t columns = static_cast<size_t>(
      std::ranges::count_if(samples, [&](const auto& s) { return s.row == samples.front().row; }));
  const auto add = [&](size_t i, size_t k) {
    ++pairs;
    // Differences due to visibility are excluded, because shadow rays have measured them.
    const double clear = static_cast<double>(samples[i].clear * samples[k].clear) /
                         static_cast<double>(samples[i].aimed * samples[k].aimed);
    sum += Variance::of(irradianceFrom(samples[i].direction.value, samples[i].part) -
                            irradianceFrom(samples[k].direction.value, samples[k].part),
                        sampling) *
           clear;
  };
  for (size_t i = 1; i < samples.size(); ++i)
    if (samples[i].row == samples[i - 1].row) add(i, i - 1);
  for (size_t i = columns; i < samples.size(); ++i) add(i, i - columns);
  if (pairs > 0)
    edges += sum * (tuning::ErrorEstimate::kEvenParts * .5 * static_cast<double>(samples.size()) /
                    static_cast<double>(pairs));
  if (to)
    for (const auto& s : samples)
      to->addToZones(s.direction.direction, 0, edges * (1 / static_cast<double>(samples.size())));
  return edges;
}

Variance choiceVariance(std::span<const SeenSources::Sample> samples, const SpectralSampling* sampling,
                        KernelVariances* to) {
  struct Chosen {
    Irradiance found;  // light of the image, weighted to represent images that were not sampled
    double chance;
    V3d direction;  // of one of its samples
  };
  std::vector<Chosen> chosen;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!(samples[i].chance < 1)) continue;
    if (i == 0 || samples[i].image != samples[i - 1].image)
      chosen.push_back({{}, samples[i].chance, samples[i].direction.direction});
    chosen.back().found += irradianceFrom(samples[i].direction.value, samples[i].direction.solidAngle);
  }
  Variance sum;
  const auto n = static_cast<double>(chosen.size());
  // The random choice adds little variance for an image that is nearly always sampled.
  for (size_t i = 1; i < chosen.size(); ++i) {
    const Variance part = Variance::of(chosen[i].found - chosen[i - 1].found, sampling) *
                          ((.5 - .25 * (chosen[i].chance + chosen[i - 1].chance)) * (n / (n - 1)));
    sum += part;
    if (to) to->addToZones(chosen[i].direction, 0, part);
  }
  return sum;
}

}  // namespace rsphere
