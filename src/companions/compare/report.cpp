#include "companions/compare/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rsphere {

std::string percent(double x) {
  const double size = std::abs(100 * x);
  if (size >= 1000) return fmt::format("{:.2g}%", 100 * x);
  return fmt::format("{:.{}f}%", 100 * x, size >= 10 || size == 0 ? 1 : size >= .1 ? 2 : 4);
}
std::string signedPercent(double x) { return (x < 0 ? "" : "+") + percent(x); }

std::string verdictText(const ChannelComparison& c) {
  switch (c.verdict) {
    case Verdict::same: return "the same but for noise";
    case Verdict::small: return "a bias below the tolerance";
    case Verdict::undecided: return "noise could hide more than the tolerance";
    case Verdict::differs:
      return c.beyond > 0
                 ? fmt::format("differs: {} by more than the tolerance, even after allowing for noise",
                               c.beyond == 1 ? "1 record" : fmt::format("{} records", c.beyond))
                 : "differs: a bias above the tolerance";
  }
  return "";
}

std::string_view conclusion(Verdict verdict) {
  switch (verdict) {
    case Verdict::same: return "No difference but noise";
    case Verdict::small: return "Within the tolerance: a bias that is certain, but smaller";
    case Verdict::undecided:
      return "Undecided: noise could hide a difference above the tolerance; more repeats (-Cr) or samples "
             "tell";
    case Verdict::differs: return "They differ";
  }
  return "";
}

std::string warningsText(std::span<const std::string> warnings) {
  std::string text;
  for (const std::string& warning : warnings) text += fmt::format("Warning: {}\n", warning);
  return text;
}

std::string figuresText(const Comparison& comparison, double tolerance) {
  std::string text = fmt::format(
      "{:<6}{:>11}{:>9}{:>10}{:>9}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}\n"
      "{:<6}{:>11}{:>9}{:>10}{:>9}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
      "", "original", "mean", "+-", "records", "of it", "half", "90%", "99%", "all", "within", "", "mean",
      "differs", "", "rms", "noise", "below", "below", "below", "below", percent(tolerance));
  for (const ChannelComparison& c : comparison.channels) {
    text += fmt::format("{:<6}{:>11.4e}{:>9}{:>10}{:>9}{:>10}", c.name, c.originalMean, signedPercent(c.bias),
                        percent(c.biasError), percent(c.rms), percent(c.noiseRms));
    for (const double p : c.percentiles) text += fmt::format("{:>9}", percent(p));
    text += fmt::format("{:>9}\n", percent(c.shareWithin));
  }
  const ChannelComparison& middle = comparison.middle();
  text += fmt::format("Noise of one answer (rms, {}): rsphere {}, the original {}\n", middle.name,
                      percent(middle.ourNoise), percent(middle.originalNoise));
  for (const ChannelComparison& c : comparison.channels)
    text += fmt::format("{}: {}\n", c.name, verdictText(c));
  return text + fmt::format("{}.\n", conclusion(comparison.verdict));
}

std::string equalErrorText(const Comparison& comparison, int orientations, double ourSeconds,
                           double originalSeconds) {
  const double ours = comparison.middle().ourNoise, theirs = comparison.middle().originalNoise;
  if (ours <= 0 || theirs <= 0) return "Equal error: one of them has no noise to go by.\n";
  const double ratio = theirs / ours;
  const double fewest = std::min(ratio, ratio * ratio), most = std::max(ratio, ratio * ratio);
  constexpr double kLeast = 8, kMost = 1e6;  // limits of -Cn
  if (orientations * fewest > kMost)
    return fmt::format(
        "Equal error: more than the {:.0f} rays that -Cn allows; fewer directions of rsphere (-Sn, -Sx) "
        "do it.\n",
        kMost);
  if (orientations * most < kLeast)
    return fmt::format(
        "Equal error: fewer than the {:.0f} rays that -Cn needs; more directions of rsphere (-Sn, -Sx) do "
        "it.\n",
        kLeast);
  const auto rays = [&](double factor) { return std::clamp(orientations * factor, kLeast, kMost); };
  return fmt::format(
      "Equal error: with -Cn {:.0f} to {:.0f} the original is about as noisy as rsphere (its noise falls "
      "with the "
      "number of rays, or its square root). All repeats then take it about {:.3g} to {:.3g} s of CPU "
      "time; rsphere took {:.3g} s.\n",
      rays(fewest), rays(most), originalSeconds * rays(fewest) / orientations,
      originalSeconds * rays(most) / orientations, ourSeconds);
}

std::vector<DifferenceClass> differenceClasses(std::span<const RecordDifference> records, double tolerance) {
  const double unit = tolerance > 0 ? tolerance : 1e-6;
  constexpr std::array kEdges = {-8., -4., -2., -1., -.5, .5, 1., 2., 4., 8.};  // in units of the tolerance
  std::vector<DifferenceClass> classes(kEdges.size() + 1);
  for (size_t k = 0; k < classes.size(); ++k) {
    classes[k].low = k > 0 ? signedPercent(kEdges[k - 1] * unit) : "less";
    classes[k].high = k < kEdges.size() ? signedPercent(kEdges[k] * unit) : "more";
    classes[k].within = k > 0 && k < kEdges.size() && kEdges[k - 1] >= -1 && kEdges[k] <= 1;
  }
  for (const RecordDifference& r : records)
    ++classes[static_cast<size_t>(std::ranges::lower_bound(kEdges, r.difference / unit) - kEdges.begin())]
          .records;
  return classes;
}

std::string histogramText(std::span<const RecordDifference> records, double tolerance) {
  constexpr int kWidest = 50;
  const std::vector<DifferenceClass> classes = differenceClasses(records, tolerance);
  size_t most = 0;
  for (const DifferenceClass& c : classes) most = std::max(most, c.records);
  std::string text = "Relative difference of records (brightness)\n";
  for (const DifferenceClass& c : classes)
    text += fmt::format("{:>9} to {:<9}{:>9}  {}\n", c.low, c.high, c.records,
                        std::string((c.records * kWidest + most - 1) / most, '#'));
  return text;
}

namespace {

// colorOf: converts a relative difference to three channels.
Raster rasterOf(int64_t width, int64_t height, std::span<const RecordDifference> records,
                const auto& colorOf) {
  Raster raster{static_cast<int>(width), static_cast<int>(height), {}};
  raster.pixels.reserve(records.size() * 3);
  for (const RecordDifference& r : records)
    for (const double c : colorOf(r.difference)) raster.pixels.push_back(static_cast<float>(c));
  return raster;
}

}  // namespace

Raster differencesOnScreen(int64_t width, int64_t height, std::span<const RecordDifference> records,
                           double tolerance) {
  constexpr double kFullColor = 10;  // in units of the tolerance
  const double full = kFullColor * (tolerance > 0 ? tolerance : 1e-6);
  return rasterOf(width, height, records, [&](double difference) {
    const double pale = 1 - std::min(1., std::abs(difference) / full);
    return difference > 0 ? std::array{1., pale, pale} : std::array{pale, pale, 1.};
  });
}

void writeDifferences(const std::string& name, int64_t width, int64_t height,
                      std::span<const RecordDifference> records, double tolerance) {
  PictureFile file(name);
  file.write(file.format() == PictureFormat::screen ? differencesOnScreen(width, height, records, tolerance)
                                                    : rasterOf(width, height, records,
                                                               [](double difference) {
                                                                 const double size = std::abs(difference);
                                                                 return std::array{size, size, size};
                                                               }),
             "#?RADIANCE\n");
}

}  // namespace rsphere
