#include "companions/trade/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace rsphere {
namespace {

double normal(Random& random) {
  const double r = std::sqrt(-2 * std::log(1 - random.uniform()));
  return r * std::cos(2 * std::numbers::pi * random.uniform());
}

constexpr size_t kPoints = 24;

// The exact answers to the points are 1, 2, 3 and so on.
RepeatedAnswers answersOf(size_t repeats, double noise, double bias, uint64_t seed) {
  Random random(seed);
  RepeatedAnswers answers{kPoints, {}};
  for (size_t k = 0; k < repeats * kPoints; ++k)
    answers.values.push_back(static_cast<double>(k % kPoints + 1) * (1 + bias + noise * normal(random)));
  return answers;
}

Trial trialOf(double noise, double bias, uint64_t seed, size_t repeats = 8) {
  Trial trial;
  trial.answers = answersOf(repeats, noise, bias, seed);
  for (size_t i = 0; i < kPoints; ++i) trial.estimates.push_back(noise * static_cast<double>(i + 1));
  return trial;
}

TEST(Reference, KnowsItsError) {
  const Reference reference(answersOf(64, .008, 0, 1));
  EXPECT_NEAR(reference.error(), .001, .0002);
  EXPECT_NEAR(reference.meanError(), .001 / std::sqrt(kPoints), .0001);
  EXPECT_NEAR(reference.mean(9), 10, 10 * .004);
  EXPECT_EQ(reference.repeats(), 64u);
}

TEST(Reference, KnowsTheDark) {
  EXPECT_TRUE(Reference({2, {0, 0, 0, 0}}).isDark());
  EXPECT_FALSE(Reference({2, {0, 0, 0, 1}}).isDark());
}

TEST(Figures, AreThoseOfNoiseAndBias) {
  const Reference exact(answersOf(2, 0, 0, 1));
  const Figures f = figuresOf(trialOf(.01, .02, 2), exact);
  const double rms = std::hypot(.01, .02);
  EXPECT_NEAR(f.rms, rms, .1 * rms);
  EXPECT_GT(f.rmsAtMost, rms);
  EXPECT_NEAR(f.bias, .02, 4 * f.biasError);
  EXPECT_NEAR(f.biasError, .01 / std::sqrt(8. * kPoints), .0005);
  EXPECT_NEAR(f.estimated, .01, 1e-12);
  EXPECT_TRUE(f.biased);
  EXPECT_FALSE(f.limited);
  EXPECT_FALSE(figuresOf(trialOf(.01, 0, 3), exact).biased);
}

// A false bias is claimed once in a hundred times; a bias of half the noise is nearly always found.
TEST(Figures, ClaimNoBiasWhereThereIsNone) {
  int alarms = 0, spoiled = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    const Reference reference(answersOf(16, .01, 0, mixBits(seed)));
    alarms += figuresOf(trialOf(.01, 0, mixBits(~seed)), reference).biased;
    spoiled += figuresOf(trialOf(.01, .005, mixBits(~seed)), reference).biased;
  }
  EXPECT_LE(alarms, 12);  // 4 expected; 12 and more once in a thousand
  EXPECT_GE(spoiled, 300);
}

// The noise of the reference is not counted as an error of a setting. If it hides
// that error, `limited` is set.
TEST(Figures, AreWithoutTheErrorOfTheReference) {
  const Reference good(answersOf(16, .02, 0, 5));  // .5%
  const Figures f = figuresOf(trialOf(.02, 0, 6), good);
  EXPECT_NEAR(f.rms, .02, .003);
  EXPECT_FALSE(f.limited);
  const Figures hidden = figuresOf(trialOf(.002, 0, 7), good);
  EXPECT_TRUE(hidden.limited);
  EXPECT_LT(hidden.rms, .005);
  EXPECT_GT(hidden.rmsAtMost, .004);
}

TEST(Figures, DarkPointsHaveAScale) {
  RepeatedAnswers answers{2, {0, 1, 0, 1}};
  Trial trial;
  trial.answers = {2, {.01, 1, .01, 1}};
  EXPECT_NEAR(figuresOf(trial, Reference(answers)).largest, .01 / (kDarkestPoint * .5), 1e-9);
}

Figures of(double seconds, double rms) {
  Figures f;
  f.seconds = seconds;
  f.rms = f.rmsAtMost = rms;
  return f;
}

TEST(MarkBest, LeavesWhatIsBeaten) {
  std::vector<Figures> all{of(1, .1), of(2, .05), of(2, .06), of(3, .05), of(4, .01), of(.5, .2), of(.6, .2)};
  markBest(all);
  const std::vector<bool> best{true, true, false, false, true, true, false};
  for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].best, best[i]) << i;
}

TEST(Cheapest, IsTheFastestThatIsAccurateEnough) {
  const std::vector<Figures> all{of(1, .1), of(2, .05), of(1.5, .05), of(4, .01)};
  EXPECT_EQ(cheapest(all, .05), 2u);
  EXPECT_EQ(cheapest(all, .02), 3u);
  EXPECT_EQ(cheapest(all, .001), std::nullopt);
}

}  // namespace
}  // namespace rsphere
