#include "companions/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "companions/measure/statistics.h"

namespace rsphere {
namespace {

// If no bias is certain: a bias above the tolerance is ruled out if its probability is below this.
constexpr double kUndecided = .05;

using Values = std::vector<double>;  // a single channel of Answers::values

template <class F>
Values valuesOf(const Answers& answers, const F& valueOf) {
  Values values;
  values.reserve(answers.values.size());
  for (const Color& value : answers.values) values.push_back(valueOf(value));
  return values;
}

size_t channelsOf(const Answers& answers) { return answers.sampling ? answers.sampling->count() : 3; }

Values channelOf(const Answers& answers, size_t channel) {
  const SpectralSampling* const sampling = answers.sampling;
  return valuesOf(answers, [&](const Color& value) {
    return sampling ? value.bandsIn(*sampling).values()[channel] : value[static_cast<int>(channel)];
  });
}

Values brightnessesOf(const Answers& answers) {
  return valuesOf(answers, [&](const Color& value) { return photopicOf(value, answers.sampling); });
}

std::string nameOf(const Answers& answers, size_t channel) {
  constexpr std::array kNames = {"red", "green", "blue"};
  if (!answers.sampling) return kNames[channel];
  const SpectralSampling& s = *answers.sampling;
  return fmt::format("{:.0f} nm", s.longest - (static_cast<double>(channel) + .5) * s.width());
}

struct Pair {
  Spread ours, original;
  double difference() const { return ours.mean() - original.mean(); }
  double variance() const {  // of the difference
    return (ours.variance() + original.variance()) / static_cast<double>(ours.count());
  }
};

std::vector<Pair> pairsOf(const Values& ours, const Values& original, size_t records) {
  std::vector<Pair> pairs(records);
  for (size_t i = 0; i < ours.size(); ++i) {
    pairs[i % records].ours.add(ours[i]);
    pairs[i % records].original.add(original[i]);
  }
  return pairs;
}

// The scale for the differences of a record: the mean of both programs. With the mean of one program, an
// outlier of that program would also enlarge the scale, so that its noise would look smaller than the
// other's.
double scaleOf(const Pair& pair, double mean) {
  const double own = std::abs(pair.original.mean() + pair.ours.mean()) / 2;
  return std::max({own, kDarkest * std::abs(mean), 1e-300});
}

double meanOf(const std::vector<Pair>& pairs, Spread Pair::*program) {
  double sum = 0;
  for (const Pair& pair : pairs) sum += (pair.*program).mean();
  return sum / static_cast<double>(pairs.size());
}

// Standard error of the mean difference, and its degrees of freedom.
struct MeanError {
  double error;
  size_t degrees;
};
MeanError meanError(const std::vector<Pair>& pairs, const Values& ours, const Values& original,
                    bool independent) {
  const size_t records = pairs.size(), repeats = ours.size() / records;
  if (independent) {
    double variance = 0;
    for (const Pair& pair : pairs) variance += pair.variance();
    return {std::sqrt(variance) / static_cast<double>(records), 2 * records * (repeats - 1)};
  }
  Spread differences;
  for (size_t r = 0; r < repeats; ++r) {
    double sum = 0;
    for (size_t i = r * records; i < (r + 1) * records; ++i) sum += ours[i] - original[i];
    differences.add(sum / static_cast<double>(records));
  }
  return {differences.standardError(), repeats - 1};
}

// channels: number of channels that are compared.
ChannelComparison compareChannel(const Values& ours, const Values& original, size_t records, size_t channels,
                                 double tolerance, double shareBeyond, bool independent) {
  const std::vector<Pair> pairs = pairsOf(ours, original, records);
  const auto n = static_cast<double>(records), tests = static_cast<double>(channels);
  ChannelComparison c;
  c.ourMean = meanOf(pairs, &Pair::ours);
  c.originalMean = meanOf(pairs, &Pair::original);
  const double scale = c.originalMean != 0 ? std::abs(c.originalMean) : std::max(std::abs(c.ourMean), 1e-300);
  const MeanError error = meanError(pairs, ours, original, independent);
  // The original computes in single precision, so its answers are rounded.
  constexpr double kRounding = 1e-6;
  const auto certain = [&](double excess, double standardError, size_t degrees, double count) {
    return excess > kRounding && chanceOf(excess, standardError, degrees) < kFalseAlarm / count;
  };
  c.bias = (c.ourMean - c.originalMean) / scale;
  c.biasError = error.error / scale;
  c.chance = std::abs(c.bias) <= kRounding ? 1 : chanceOf(c.bias, c.biasError, error.degrees);

  std::vector<double> sizes;
  double squares = 0, noise = 0, ourNoise = 0, originalNoise = 0;
  for (const Pair& pair : pairs) {
    const double by = scaleOf(pair, c.originalMean), size = std::abs(pair.difference()) / by;
    // Divided twice, because the square of the scale underflows to 0 if all answers are 0.
    sizes.push_back(size);
    squares += size * size;
    noise += pair.variance() / by / by;
    ourNoise += pair.ours.variance() / by / by;
    originalNoise += pair.original.variance() / by / by;
    const size_t degrees = 2 * (pair.ours.count() - 1);
    c.beyond += certain(size - tolerance, std::sqrt(pair.variance()) / by, degrees, tests * n);
  }
  c.rms = std::sqrt(squares / n);
  c.noiseRms = std::sqrt(noise / n);
  c.ourNoise = std::sqrt(ourNoise / n);
  c.originalNoise = std::sqrt(originalNoise / n);
  std::ranges::sort(sizes);
  for (size_t k = 0; k < kPercentiles.size(); ++k)
    c.percentiles[k] = sizes[static_cast<size_t>(std::lround(kPercentiles[k] * (n - 1)))];
  c.shareWithin = static_cast<double>(std::ranges::upper_bound(sizes, tolerance) - sizes.begin()) / n;

  const double room = tolerance + 2 * kRounding - std::abs(c.bias);
  if (certain(std::abs(c.bias) - tolerance, c.biasError, error.degrees, tests) ||
      static_cast<double>(c.beyond) > shareBeyond * n)
    c.verdict = Verdict::differs;
  else if (room <= 0 || chanceOf(room, c.biasError, error.degrees) > kUndecided)
    c.verdict = Verdict::undecided;
  else
    c.verdict = c.chance < kFalseAlarm / tests ? Verdict::small : Verdict::same;
  return c;
}

}  // namespace

Color meanOf(const Answers& answers, size_t record) {
  Color sum(0, 0, 0);
  for (size_t r = 0; r < answers.repeats; ++r) sum += answers.of(record, r);
  return sum / static_cast<double>(answers.repeats);
}

double brightnessOf(const Answers& answers, size_t record) {
  return photopicOf(meanOf(answers, record), answers.sampling);
}

Comparison compare(const Answers& ours, const Answers& original, double tolerance, double shareBeyond,
                   bool independentRecords) {
  Comparison comparison;
  const size_t channels = channelsOf(ours);
  comparison.channels.clear();
  for (size_t channel = 0; channel < channels; ++channel) {
    comparison.channels.push_back(compareChannel(channelOf(ours, channel), channelOf(original, channel),
                                                 ours.records, channels, tolerance, shareBeyond,
                                                 independentRecords));
    comparison.channels.back().name = nameOf(ours, channel);
  }
  for (const ChannelComparison& c : comparison.channels)
    comparison.verdict = std::max(comparison.verdict, c.verdict);

  const std::vector<Pair> pairs = pairsOf(brightnessesOf(ours), brightnessesOf(original), ours.records);
  const double mean = meanOf(pairs, &Pair::original);
  for (const Pair& pair : pairs) {
    const double by = scaleOf(pair, mean);
    comparison.records.push_back({pair.difference() / by, std::sqrt(pair.variance()) / by});
  }
  const auto excess = [&](size_t i) {
    const RecordDifference& r = comparison.records[i];
    return std::abs(r.difference) - 2 * r.error;
  };
  comparison.worst.resize(ours.records);
  std::iota(comparison.worst.begin(), comparison.worst.end(), 0);
  std::ranges::stable_sort(comparison.worst, [&](size_t a, size_t b) { return excess(a) > excess(b); });
  return comparison;
}

}  // namespace rsphere
