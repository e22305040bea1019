#include "estimate/two_halves.h"

#include <cmath>
#include <optional>
#include <vector>

#include "base/constants.h"
#include "glances/tuning.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

// A set of directions, as far as its average tells: 64 values with a mean of 1, few of which are most of the
// light (log-normal), so that a set that finds little estimates a small error.
struct Set {
  double total = 0, variance = 0;
  explicit Set(Random& random) {
    constexpr int kValues = 64;
    double squares = 0;
    for (int i = 0; i < kValues; ++i) {
      const double radius = std::sqrt(-2 * std::log1p(-random.uniform()));
      const double x = std::exp(.7 * radius * std::cos(2 * kPi * random.uniform()) - .245);
      total += x / kValues;
      squares += x * x;
    }
    variance = (squares / kValues - total * total) / (kValues - 1);
  }
};

struct Outcome {
  Sample mean;
  double sets = 0, largestError = 0;
};

Outcome withHalves(double accuracy, int answers) {
  Random random(1);
  Outcome run;
  for (int k = 0; k < answers; ++k) {
    TwoHalves decision(accuracy);
    double totals[2] = {0, 0}, variances[2] = {0, 0};
    while (const auto half = decision.next()) {
      const Set set(random);
      decision.add(*half, set.total, set.variance);
      totals[*half] += set.total;
      variances[*half] += set.variance;
      ++run.sets;
    }
    double mean = 0, variance = 0;
    for (const size_t half : {0u, 1u}) {
      mean += decision.share(half) * totals[half];
      variance += std::pow(decision.share(half), 2) * variances[half];
    }
    EXPECT_TRUE(decision.isReached());
    run.mean.add(mean);
    run.largestError = std::max(run.largestError, std::sqrt(variance) / mean);
  }
  run.sets /= answers;
  return run;
}

// As before there were halves.
Outcome stoppingOnItsOwn(double accuracy, int answers) {
  Random random(1);
  Outcome run;
  for (int k = 0; k < answers; ++k) {
    double total = 0, variance = 0;
    int sets = 0;
    do {
      const Set set(random);
      total += set.total;
      variance += set.variance;
      ++sets;
    } while (std::sqrt(variance) > accuracy * total);
    run.sets += sets;
    run.mean.add(total / sets);
  }
  run.sets /= answers;
  return run;
}

TEST(TwoHalves, StopWithAFractionOfTheBiasOfOne) {
  constexpr double kAccuracy = .05;  // 4 sets
  constexpr int kAnswers = 10000;
  const Outcome halves = withHalves(kAccuracy, kAnswers), one = stoppingOnItsOwn(kAccuracy, kAnswers);
  RecordProperty("halves", std::to_string(halves.mean.mean() - 1));
  RecordProperty("one", std::to_string(one.mean.mean() - 1));
  EXPECT_LT(one.mean.mean(), 1 - kMostSigmas * one.mean.standardError())
      << "the sample is too small to see a bias";
  EXPECT_LT(std::abs(halves.mean.mean() - 1), (1 - one.mean.mean()) / 3);
  EXPECT_LE(halves.largestError, kAccuracy);
  EXPECT_LT(halves.sets, 1.35 * one.sets);
}

TEST(TwoHalves, OneSetIsEnoughWithoutAnAccuracy) {
  TwoHalves decision(0);
  ASSERT_EQ(decision.next(), std::optional<size_t>(0));
  decision.add(0, 1, 100);
  EXPECT_EQ(decision.next(), std::nullopt);
  EXPECT_EQ(decision.share(0), 1);
  EXPECT_EQ(decision.share(1), 0);
}

TEST(TwoHalves, NothingToFindIsFoundWithTwoSets) {
  TwoHalves dark(.01);
  for (const size_t half : {0u, 1u}) {
    ASSERT_EQ(dark.next(), std::optional<size_t>(half));
    dark.add(half, 0, 0);
  }
  EXPECT_EQ(dark.next(), std::nullopt);
  EXPECT_TRUE(dark.isReached());
}

TEST(TwoHalves, GiveUpInTheDark) {
  TwoHalves dark(.01, 1), lit(.01, 1);
  for (size_t sets = 0; sets < tuning::DiffuseGlances::kPools; ++sets) {
    const auto half = dark.next();
    ASSERT_TRUE(half);
    dark.add(*half, .5, 1);
    lit.add(*lit.next(), 2, 4);
  }
  EXPECT_EQ(dark.next(), std::nullopt);
  EXPECT_FALSE(dark.isReached());
  EXPECT_TRUE(dark.gaveUp());
  EXPECT_TRUE(lit.next());
  EXPECT_FALSE(lit.gaveUp()) << "it is only not accurate yet";
}

TEST(TwoHalves, GoOnWhereTheMeanIsNoneOfLight) {
  TwoHalves decision(.01);
  for (int sets = 0; sets < 1000; ++sets) {
    const auto half = decision.next();
    ASSERT_TRUE(half);
    decision.add(*half, 0, 1);
  }
  EXPECT_FALSE(decision.isReached());
}

// A set a hundred times as noisy as the others is outweighed by sets of its own half, before the other half
// has hundreds.
TEST(TwoHalves, OneNoisySetCostsFewOthers) {
  TwoHalves decision(.01);
  int sets = 0;
  while (const auto half = decision.next()) {
    decision.add(*half, 1, sets == 0 ? 1e-4 * 100 : 1e-4);
    ++sets;
  }
  EXPECT_GE(sets, 10);
  EXPECT_LE(sets, 24);
}

TEST(TwoHalves, SharesSumToOne) {
  TwoHalves decision(.01);
  Random random(3);
  double counts[2] = {0, 0};
  while (const auto half = decision.next()) {
    decision.add(*half, 1 + .01 * random.uniform(), 1e-3 * random.uniform());
    ++counts[*half];
  }
  EXPECT_NEAR(counts[0] * decision.share(0) + counts[1] * decision.share(1), 1, 1e-12);
  EXPECT_LE(std::max(counts[0], counts[1]), 2 * std::min(counts[0], counts[1]) + 1);
}

}  // namespace
}  // namespace rsphere
