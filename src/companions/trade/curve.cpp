#include "companions/trade/curve.h"

#include <algorithm>
#include <cmath>

#include "companions/measure/statistics.h"

namespace rsphere {
namespace {

// Statistics over repeats, each of which is represented by the mean of valueOf() over all points.
Spread meansOfRepeats(const RepeatedAnswers& answers, const auto& valueOf) {
  Spread means;
  for (size_t r = 0; r < answers.repeats(); ++r) {
    double sum = 0;
    for (size_t i = 0; i < answers.points; ++i) sum += valueOf(i, answers.values[r * answers.points + i]);
    means.add(sum / static_cast<double>(answers.points));
  }
  return means;
}

}  // namespace

Reference::Reference(const RepeatedAnswers& answers) : repeats_(answers.repeats()) {
  std::vector<Spread> spreads(answers.points);
  double sum = 0;
  for (size_t k = 0; k < answers.values.size(); ++k) spreads[k % answers.points].add(answers.values[k]);
  for (const Spread& s : spreads) sum += std::abs(s.mean());
  const double least = std::max(kDarkestPoint * sum / static_cast<double>(answers.points), 1e-300);
  double squares = 0;
  for (const Spread& s : spreads) {
    means_.push_back(s.mean());
    scales_.push_back(std::max(std::abs(s.mean()), least));
    squares += std::pow(s.standardError() / scales_.back(), 2);
  }
  error_ = std::sqrt(squares / static_cast<double>(answers.points));
  meanError_ = meansOfRepeats(answers, [&](size_t i, double x) { return x / scales_[i]; }).standardError();
}

bool Reference::isDark() const {
  return std::ranges::all_of(means_, [](double mean) { return mean == 0; });
}

Figures figuresOf(const Trial& trial, const Reference& reference) {
  Figures f;
  f.words = trial.words;
  f.seconds = trial.seconds;
  f.setupSeconds = trial.setupSeconds;
  f.directions = trial.directions;
  const RepeatedAnswers& answers = trial.answers;
  const auto error = [&](size_t i, double x) { return (x - reference.mean(i)) / reference.scale(i); };
  double squares = 0;
  for (size_t k = 0; k < answers.values.size(); ++k) {
    const double e = error(k % answers.points, answers.values[k]);
    squares += e * e;
    f.largest = std::max(f.largest, std::abs(e));
  }
  const auto count = static_cast<double>(answers.values.size());
  const double found = squares / count, ofReference = reference.error() * reference.error();
  // Differences as small as rounding of the reference's sum are not errors.
  constexpr double kRounding = 1e-24;
  f.rms = std::sqrt(std::max(0., found - ofReference));
  f.limited = ofReference > found / 4 && found > kRounding;
  // If the error of the reference dominates, the whole difference may be the error of the setting.
  constexpr double kSure = 1.645;
  f.rmsAtMost = (f.limited ? std::sqrt(found) : f.rms) * (1 + kSure / std::sqrt(2 * count));
  const Spread means = meansOfRepeats(answers, error);
  f.bias = means.mean();
  f.biasError = std::hypot(means.standardError(), reference.meanError());
  f.biased = answers.repeats() > 1 && std::abs(f.bias) > 1e-9 &&
             chanceOf(f.bias, f.biasError, answers.repeats() - 1) < .01;
  double estimates = 0;
  for (size_t k = 0; k < trial.estimates.size(); ++k)
    estimates += std::pow(trial.estimates[k] / reference.scale(k % answers.points), 2);
  if (!trial.estimates.empty())
    f.estimated = std::sqrt(estimates / static_cast<double>(trial.estimates.size()));
  return f;
}

void markBest(std::vector<Figures>& all) {
  for (Figures& one : all)
    one.best = std::ranges::none_of(all, [&](const Figures& other) {
      return other.seconds <= one.seconds && other.rms <= one.rms &&
             (other.seconds < one.seconds || other.rms < one.rms);
    });
}

std::optional<size_t> cheapest(std::span<const Figures> all, double accuracy) {
  std::optional<size_t> found;
  for (size_t i = 0; i < all.size(); ++i)
    if (all[i].rmsAtMost <= accuracy && (!found || all[i].seconds < all[*found].seconds)) found = i;
  return found;
}

Recommendation recommend(std::span<const Figures> all, double accuracy) {
  if (const auto found = cheapest(all, accuracy)) return {*found, true};
  const auto nearest = std::ranges::min_element(all, {}, &Figures::rms);
  return {static_cast<size_t>(nearest - all.begin()), false};
}

}  // namespace rsphere
