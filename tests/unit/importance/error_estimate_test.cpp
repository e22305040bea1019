#include "importance/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "base/constants.h"
#include "importance/tuning.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

// Independent values of variance 1/12 in a grid of `side` by `side` cells of solid angle 1.
std::vector<SeenSources::Sample> grid(size_t side, Random& random) {
  std::vector<SeenSources::Sample> samples(side * side);
  for (size_t i = 0; i < samples.size(); ++i) {
    const double value = random.uniform();
    samples[i].direction.value = Radiance(value);
    samples[i].part = samples[i].direction.solidAngle = 1;
    samples[i].row = i / side;
  }
  return samples;
}

// Half the variance of independent values: tuning::ErrorEstimate::kEvenParts.
TEST(ErrorEstimate, PartsOfASourceHaveHalfTheVarianceOfIndependentOnes) {
  Random random(1);
  Sample ratio;
  for (int i = 0; i < 400; ++i) ratio.add(partsVariance(grid(8, random)).brightness / (64 / 12.));
  expectMean(ratio, .5, 1.1);
}

// A cell half of whose four shadow rays are blocked has the variance 1/4 / 4 of a mean of four.
TEST(ErrorEstimate, PartlyHiddenPartsVary) {
  SeenSources::Sample half;
  half.direction.value = Radiance(1);
  half.part = 1;
  half.aimed = 4;
  half.clear = 2;
  EXPECT_NEAR(partsVariance(std::vector{half}).brightness, .5 * .25 / 4, 1e-12);
}

// Values on a torus of `side` by `side` cells of solid angle 1 with six neighbours each, as even directions have.
struct Torus {
  std::vector<DirectionSample> samples;
  Neighbours neighbours;
  Torus(size_t side, const std::function<double(size_t x, size_t y)>& valueAt) {
    constexpr int kSteps[6][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
    for (size_t y = 0; y < side; ++y)
      for (size_t x = 0; x < side; ++x) {
        samples.push_back({V3d(0, 0, 1), 1, Radiance(valueAt(x, y))});
        neighbours.first.push_back(static_cast<uint32_t>(neighbours.neighbour.size()));
        for (const auto& [dx, dy] : kSteps)
          neighbours.neighbour.push_back(
              static_cast<uint32_t>((y + side + dy) % side * side + (x + side + dx) % side));
      }
    neighbours.first.push_back(static_cast<uint32_t>(neighbours.neighbour.size()));
  }
  double variance(bool even) const {
    return localVariance(samples, even ? samples.size() : 0, neighbours, {}).brightness;
  }
};

TEST(ErrorEstimate, NoiseIsStatedWholeHoweverItIsSeen) {
  Random random(1);
  Sample even, others;
  for (int i = 0; i < 100; ++i) {
    const Torus noise(16, [&](size_t, size_t) { return random.uniform(); });
    even.add(noise.variance(true) / (256 / 12.));
    others.add(noise.variance(false) / (256 / 12.));
  }
  expectMean(even, tuning::ErrorEstimate::kEvenSet, 1.05);
  expectMean(others, tuning::ErrorEstimate::kAmongOthers, 1.05);
}

// Light that varies smoothly, here by one wave in 16 directions, is integrated by an even set.
TEST(ErrorEstimate, BendsOfSmoothLightAreNoErrors) {
  const Torus wave(16, [](size_t x, size_t) { return std::cos(2 * kPi * static_cast<double>(x) / 16); });
  EXPECT_LT(wave.variance(true), .0005 * 256 / 2);
  EXPECT_GT(wave.variance(false), .002 * 256 / 2) << "differences alone would not tell them from noise";
}

// What few directions find is an error as if they were alone, wherever they are.
TEST(ErrorEstimate, WhatOneDirectionFindsIsUncertain) {
  const Torus spark(16, [](size_t x, size_t y) { return x == 3 && y == 5 ? 1. : 0; });
  EXPECT_NEAR(spark.variance(true), tuning::ErrorEstimate::kEvenSet, .02);
  EXPECT_NEAR(spark.variance(false), tuning::ErrorEstimate::kAmongOthers, .02);
}

// Four directions in a row, two of which see a window that is brighter than the wall beside it.
TEST(ErrorEstimate, EdgesOfRegionsAreNoErrors) {
  const std::vector<DirectionSample> base = {{V3d(0, 0, 1), 1, Radiance(1)},
                                             {V3d(0, 0, 1), 1, Radiance(1)},
                                             {V3d(0, 0, 1), 1, Radiance(9)},
                                             {V3d(0, 0, 1), 1, Radiance(9)}};
  const Neighbours row{{0, 1, 3, 5, 6}, {1, 0, 2, 1, 3, 2}};
  const double factor = tuning::ErrorEstimate::kAmongOthers;
  // The difference of 4 to the mean of two neighbours, twice.
  EXPECT_NEAR(localVariance(base, 4, row, {}).brightness, factor * 2 * 16 * 2 / 3, 1e-12);
  EXPECT_EQ(localVariance(base, 4, row, std::vector<RegionId>{0, 0, 5, 5}).brightness, 0);
  // A direction that is alone in its region is compared with all neighbours.
  EXPECT_NEAR(localVariance(base, 4, row, std::vector<RegionId>{0, 0, 5, 6}).brightness,
              factor * (16 * 2. / 3 + 0), 1e-12);
  EXPECT_EQ(localVariance(base, 4, row, std::vector<RegionId>{0, 0, kNoRegion, kNoRegion}).brightness, 0);
}

// Three directions that see the same sky through a window of 6 sr, and one that sees the wall.
TEST(ErrorEstimate, SomethingMayHaveBeenMissedInARegion) {
  const std::vector<DirectionSample> samples = {{V3d(0, 0, 1), 2, Radiance(4)},
                                                {V3d(0, 0, 1), 2, Radiance(4)},
                                                {V3d(0, 0, 1), 2, Radiance(4)},
                                                {V3d(0, 0, 1), 2, Radiance(1)}};
  const double missed = tuning::ErrorEstimate::kUnseen * 24 / 4;
  EXPECT_NEAR(unseenVariance(samples, std::vector<RegionId>{1, 1, 1, 0}).brightness, missed * missed, 1e-12);
  EXPECT_EQ(unseenVariance(samples, std::vector<RegionId>{0, 0, kNoRegion, 0}).brightness, 0);
}

}  // namespace
}  // namespace rsphere
