#include "companions/compare/comparison.h"

#include <gtest/gtest.h>

#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

double normal(Random& random) {
  const double r = std::sqrt(-2 * std::log(1 - random.uniform()));
  return r * std::cos(2 * std::numbers::pi * random.uniform());
}

// Records with values from 1 to 2, with relative noise and bias.
Answers answersOf(size_t records, size_t repeats, double noise, double bias, uint64_t seed) {
  Random random(seed);
  Answers answers{records, repeats, {}};
  for (size_t r = 0; r < repeats; ++r)
    for (size_t i = 0; i < records; ++i) {
      const double value = 1 + static_cast<double>(i) / static_cast<double>(records);
      Color color;
      for (int c = 0; c < 3; ++c) color[c] = value * (1 + bias) * (1 + noise * normal(random));
      answers.values.push_back(color);
    }
  return answers;
}

constexpr double kTolerance = .002, kShare = .001;

Comparison ofBias(double bias, double noise, uint64_t seed, double tolerance = kTolerance) {
  return compare(answersOf(300, 8, noise, bias, mixBits(seed)), answersOf(300, 8, noise, 0, mixBits(~seed)),
                 tolerance, kShare, true);
}

TEST(Compare, TellsABiasFromNoise) {
  EXPECT_EQ(ofBias(.005, .01, 1).verdict, Verdict::differs);
  EXPECT_EQ(ofBias(0, .01, 2).verdict, Verdict::same);
}

TEST(Compare, ABiasBelowTheToleranceIsSmall) {
  const Comparison comparison = ofBias(.005, .01, 3, .01);
  EXPECT_EQ(comparison.verdict, Verdict::small);
  EXPECT_NEAR(comparison.channels[1].bias, .005, 4 * comparison.channels[1].biasError);
}

TEST(Compare, TooMuchNoiseIsUndecided) {
  EXPECT_EQ(ofBias(0, .3, 4).verdict, Verdict::undecided);
  EXPECT_EQ(ofBias(.005, .3, 4).verdict, Verdict::undecided);
}

// Values with rare bright outliers. The scale of a record is the mean of both programs, so that the outliers
// of one program do not make its noise look smaller than that of the other.
TEST(Compare, BothProgramsNoiseIsTakenAlike) {
  const auto rare = [](uint64_t seed) {
    Random random(seed);
    Answers answers{8000, 8, {}};
    for (size_t i = 0; i < 8000 * 8; ++i) {
      const double value = random.uniform() < .01 ? 30 : 1;
      answers.values.push_back(Color(value, value, value));
    }
    return answers;
  };
  const ChannelComparison c = compare(rare(1), rare(2), kTolerance, kShare, true).channels[1];
  EXPECT_NEAR(c.ourNoise, c.originalNoise, .1 * c.originalNoise);
}

// kFalseAlarm holds for all channels together. A bias of a tenth of the noise must always be found.
TEST(Compare, FalseAlarmsAreAsRareAsSaid) {
  int alarms = 0, spoiled = 0;
  constexpr int kRuns = 300;
  for (uint64_t seed = 0; seed < kRuns; ++seed) {
    const auto is = [&](double bias) {
      return compare(answersOf(40, 4, .01, bias, mixBits(seed)), answersOf(40, 4, .01, 0, mixBits(~seed)),
                     .01, kShare, true)
                 .verdict != Verdict::same;
    };
    alarms += is(0);
    spoiled += is(.005);
  }
  EXPECT_LE(alarms, 3);  // .3 expected; more than 3 once in 4000
  EXPECT_GT(spoiled, kRuns / 2);
}

// If records share their noise, as points that share directions do, the error
// follows only from whole repeats.
TEST(Compare, SharedNoiseIsNoBias) {
  int alarms = 0, naive = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Random random(mixBits(seed));
    Answers ours = answersOf(50, 6, .001, 0, seed), theirs = answersOf(50, 6, .001, 0, ~seed);
    for (size_t r = 0; r < ours.repeats; ++r) {
      const double shared = 1 + .01 * normal(random);
      for (size_t i = 0; i < ours.records; ++i) ours.values[r * ours.records + i] *= shared;
    }
    alarms += compare(ours, theirs, .5, kShare, false).verdict != Verdict::same;
    naive += compare(ours, theirs, .5, kShare, true).verdict != Verdict::same;
  }
  EXPECT_LE(alarms, 3);
  EXPECT_GT(naive, 100);
}

TEST(Compare, FindsTheRecordThatDiffers) {
  Answers ours = answersOf(300, 8, .003, 0, 5), theirs = answersOf(300, 8, .003, 0, 6);
  for (size_t r = 0; r < ours.repeats; ++r) ours.values[r * 300 + 123] *= 1.1;
  const Comparison comparison = compare(ours, theirs, .05, 0, true);
  EXPECT_EQ(comparison.worst[0], 123u);
  EXPECT_EQ(comparison.channels[0].beyond, 1u);
  EXPECT_EQ(comparison.verdict, Verdict::differs);
  EXPECT_NEAR(comparison.records[123].difference, .1, .01);
  // One of 300 records may exceed the tolerance, but it also biases the mean.
  EXPECT_EQ(compare(ours, theirs, .05, .004, true).verdict, Verdict::small);
}

TEST(Compare, FiguresAreThoseOfTheDefinition) {
  const Answers ours{4,
                     2,
                     {Color(1, 1, 1), Color(2, 2, 2), Color(3, 3, 3), Color(4.2, 4.2, 4.2), Color(1, 1, 1),
                      Color(2, 2, 2), Color(3, 3, 3), Color(4.2, 4.2, 4.2)}};
  const Answers theirs{4,
                       2,
                       {Color(1, 1, 1), Color(2, 2, 2), Color(3, 3, 3), Color(3.8, 3.8, 3.8), Color(1, 1, 1),
                        Color(2, 2, 2), Color(3, 3, 3), Color(3.8, 3.8, 3.8)}};
  const ChannelComparison c = compare(ours, theirs, .05, 0, true).channels[0];
  EXPECT_NEAR(c.bias, .4 / 9.8, 1e-12);
  EXPECT_EQ(c.biasError, 0);
  EXPECT_NEAR(c.rms, .05, 1e-12);
  EXPECT_EQ(c.shareWithin, .75);
  EXPECT_EQ(c.beyond, 1u);
  EXPECT_NEAR(c.percentiles[3], .1, 1e-12);
  EXPECT_EQ(c.percentiles[0], 0);
}

// The differences of records that are black in the original are relative to the mean.
TEST(Compare, DarkRecordsHaveAScale) {
  const Answers ours{2, 2, {Color(.01, 0, 0), Color(1, 0, 0), Color(.01, 0, 0), Color(1, 0, 0)}};
  const Answers theirs{2, 2, {Color(0, 0, 0), Color(1, 0, 0), Color(0, 0, 0), Color(1, 0, 0)}};
  const Comparison comparison = compare(ours, theirs, .05, 0, true);
  EXPECT_NEAR(comparison.channels[0].percentiles[3], .01 / (kDarkest * .5), 1e-9);
  EXPECT_EQ(comparison.channels[1].verdict, Verdict::same);
}

TEST(Compare, BlackAnswersAreTheSame) {
  const Answers black{2, 2, std::vector<Color>(4)};
  const ChannelComparison c = compare(black, black, .05, 0, true).channels[0];
  for (const double figure : {c.bias, c.biasError, c.rms, c.noiseRms, c.ourNoise, c.originalNoise})
    EXPECT_EQ(figure, 0);
  EXPECT_EQ(c.verdict, Verdict::same);
}

// In a spectral run each band is compared, and records by their photopic sums: a fault in one band is found.
TEST(Compare, BandsOfASpectralRun) {
  const SpectralSampling& sampling = spectralSampling(4, 380, 780);
  const auto bandsOf = [&](double first, double others) {
    Bands bands(sampling);
    for (double& value : bands.values()) value = others;
    bands.values()[0] = first;
    return Color(bands);
  };
  const Answers ours{1, 2, {bandsOf(1.2, 1), bandsOf(1.2, 1)}, &sampling};
  const Answers theirs{1, 2, {bandsOf(1, 1), Color(1, 1, 1)}, &sampling};
  const Comparison comparison = compare(ours, theirs, .05, 0, true);
  ASSERT_EQ(comparison.channels.size(), 4u);
  EXPECT_EQ(comparison.channels[0].name, "730 nm");
  EXPECT_EQ(comparison.middle().name, "530 nm");
  EXPECT_NEAR(comparison.channels[0].bias, .2, 1e-12);
  EXPECT_EQ(comparison.channels[0].verdict, Verdict::differs);
  for (size_t i = 1; i < 4; ++i) EXPECT_EQ(comparison.channels[i].verdict, Verdict::same);
  // The eye hardly sees the first band.
  EXPECT_GT(comparison.records[0].difference, 0);
  EXPECT_LT(comparison.records[0].difference, .01);
}

}  // namespace
}  // namespace rsphere
