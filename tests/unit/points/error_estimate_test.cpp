#include "points/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "base/constants.h"
#include "base/even_sequence.h"
#include "points/tuning.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

// Values on a torus of `side` by `side` cells of solid angle 1 with six neighbours each, as even directions
// have.
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
  double variance() const { return evenVariance(samples, neighbours, nullptr).brightness; }
};

TEST(ErrorEstimate, NoiseIsStatedWhole) {
  Random random(1);
  Sample stated;
  for (int i = 0; i < 100; ++i) {
    const Torus noise(16, [&](size_t, size_t) { return random.uniform(); });
    stated.add(noise.variance() / (256 / 12.));
  }
  expectMean(stated, tuning::ErrorEstimate::kEvenSet, 1.05);
}

// Light that varies smoothly, here by one wave in 16 directions, is integrated by an even set.
TEST(ErrorEstimate, BendsOfSmoothLightAreNoErrors) {
  const auto waves = [](double count) {
    return Torus(16,
                 [=](size_t x, size_t) { return std::cos(2 * kPi * count * static_cast<double>(x) / 16); });
  };
  EXPECT_LT(waves(1).variance(), .0005 * 256 / 2);
  EXPECT_GT(waves(4).variance(), .05 * 256 / 2) << "would not see what varies with each direction";
}

// What one direction finds is an error as if it were alone.
TEST(ErrorEstimate, WhatOneDirectionFindsIsUncertain) {
  const Torus spark(16, [](size_t x, size_t y) { return x == 3 && y == 5 ? 1. : 0; });
  EXPECT_NEAR(spark.variance(), tuning::ErrorEstimate::kEvenSet, .02);
}

// Of n independent values, 1 / (1 + n^1/2 / 8) of the variance: tuning::ErrorEstimate::kEvenRun.
TEST(ErrorEstimate, LongRunsOfDirectionsAreTakenForEven) {
  Random random(1);
  for (const size_t n : {4, 64, 1024}) {
    Sample ratio;
    for (int i = 0; i < 800; ++i) {
      std::vector<DirectionSample> samples(n);
      for (DirectionSample& s : samples) {
        const double value = random.uniform();
        s.value = Radiance(value);
        s.solidAngle = 1;
      }
      ratio.add(spreadVariance(samples, nullptr).brightness / (static_cast<double>(n) / 12));
    }
    expectMean(ratio, 1 / (1 + std::sqrt(static_cast<double>(n)) / 8), 1.15);
  }
}

// Something that is smaller than the distance of directions is found by some of them by chance, however even
// they are.
TEST(ErrorEstimate, WhatFewDirectionsFindIsNotTakenForEven) {
  constexpr size_t kDirections = 3000;
  constexpr double kFound = 3;  // on average
  Random random(1);
  Sample stated, found;
  for (int i = 0; i < 400; ++i) {
    std::vector<DirectionSample> samples(kDirections);
    double sum = 0;
    for (DirectionSample& s : samples) {
      const bool hit = random.uniform() < kFound / kDirections;
      s.value = Radiance(hit ? 1 : 0);
      s.solidAngle = 1;
      sum += hit;
    }
    stated.add(spreadVariance(samples, nullptr).brightness);
    found.add(sum);
  }
  // By the number of all directions, the variance would be taken for 1 / (1 + 3000^1/2 / 8) = .13 of what it
  // is.
  EXPECT_GT(stated.mean(), .7 * found.variance());
  EXPECT_LT(stated.mean(), 1 * found.variance());
}

// Directions to a target, in whose unit square valueAt() gives what they find; over random shifts of their
// places.
struct Stated {
  double found = 0, stated = 0, spread = 0;  // spread: as if nothing were known of their places
  void add(size_t directions, int shifts, Random& random,
           const std::function<double(const Imath::V2d& at)>& valueAt) {
    Sample sums;
    for (int i = 0; i < shifts; ++i) {
      const double u = random.uniform(), v = random.uniform();
      const Imath::V2d shift(u, v);
      std::vector<DirectionSample> samples(directions);
      double sum = 0;
      for (size_t k = 0; k < directions; ++k) {
        const double value = valueAt(evenly(k, u, v));
        samples[k].value = Radiance(value);
        samples[k].solidAngle = 1;
        sum += value;
      }
      sums.add(sum);
      stated += latticeVariance(samples, shift, nullptr).brightness / shifts;
      spread += spreadVariance(samples, nullptr).brightness / shifts;
    }
    found += sums.variance();
  }
  double overTrue() const { return std::sqrt(stated / found); }
  double spreadOverTrue() const { return std::sqrt(spread / found); }
};

TEST(ErrorEstimate, NoiseOfDirectionsToATargetIsStatedWhole) {
  Random random(1);
  for (const size_t n : {2, 5, 16, 400}) {
    Stated noise;
    noise.add(n, 400, random, [&](const Imath::V2d&) { return random.uniform(); });
    EXPECT_GT(noise.overTrue(), .8) << n;
    EXPECT_LT(noise.overTrue(), 1.05) << n;
    if (n < 400) continue;
    EXPECT_LT(noise.spreadOverTrue(), .6) << "would not see noise taken for edges";
  }
}

// Edges of all slopes, as those of a window in a mirror.
TEST(ErrorEstimate, EdgesInATargetAreErrorsWhereTheyPassBetweenNeighbours) {
  Random random(2);
  for (const size_t n : {64, 500}) {
    Stated edges;
    for (int i = 0; i < 40; ++i) {
      const double angle = 2 * kPi * random.uniform(), x = random.uniform(), y = random.uniform();
      edges.add(n, 40, random, [&](const Imath::V2d& at) {
        return (at.x - x) * std::cos(angle) + (at.y - y) * std::sin(angle) > 0 ? 1. : 0;
      });
    }
    EXPECT_GT(edges.overTrue(), .8) << n;
    EXPECT_LT(edges.overTrue(), 1.5) << n;
    EXPECT_GT(edges.spreadOverTrue(), 1.6) << "would not see edges taken for noise";
  }
}

// Slats that are finer than the distance of neighbours, in front of a window.
TEST(ErrorEstimate, FineSlatsAreStatedWhole) {
  Random random(3);
  Stated slats;
  for (int i = 0; i < 60; ++i) {
    const double x = 60 * random.uniform(), y = 40 + 40 * random.uniform();
    slats.add(500, 40, random, [&](const Imath::V2d& at) {
      const double row = x * at.x + y * at.y;
      return row - std::floor(row) > .5 ? 1. : 0;
    });
  }
  EXPECT_GT(slats.overTrue(), .75);
  EXPECT_LT(slats.overTrue(), 1.25);
  EXPECT_LT(slats.spreadOverTrue(), .75) << "would not see slats taken for edges";
}

// Two directions in different regions: neither can be compared, so that all that they find is uncertain.
TEST(ErrorEstimate, DirectionsThatCannotBeComparedAreUncertain) {
  std::vector<DirectionSample> samples(2);
  for (DirectionSample& s : samples) {
    s.value = Radiance(3);
    s.solidAngle = 2;
  }
  samples[0].region = kNoRegion;
  samples[1].region = 4;
  EXPECT_NEAR(latticeVariance(samples, {.5, .5}, nullptr).brightness, 36, 1e-12);
}

std::vector<DirectionSample> inRegions(std::vector<DirectionSample> samples,
                                       const std::vector<RegionId>& regions) {
  for (size_t i = 0; i < samples.size(); ++i) samples[i].region = regions[i];
  return samples;
}

// Four directions in a row, two of which see a window that is brighter than the wall beside it.
TEST(ErrorEstimate, EdgesOfRegionsAreNoErrors) {
  const std::vector<DirectionSample> base = {{V3d(0, 0, 1), 1, Radiance(1)},
                                             {V3d(0, 0, 1), 1, Radiance(1)},
                                             {V3d(0, 0, 1), 1, Radiance(9)},
                                             {V3d(0, 0, 1), 1, Radiance(9)}};
  const Neighbours row{{0, 1, 3, 5, 6}, {1, 0, 2, 1, 3, 2}};
  const double even = tuning::ErrorEstimate::kEvenSet;
  // The difference of 4 to the mean of two neighbours, twice.
  EXPECT_NEAR(evenVariance(base, row, nullptr).brightness, even * 2 * 16 * 2 / 3, 1e-12);
  EXPECT_EQ(evenVariance(inRegions(base, {0, 0, 5, 5}), row, nullptr).brightness, 0);
  // A direction that is alone in its region is compared with all neighbours.
  EXPECT_NEAR(evenVariance(inRegions(base, {0, 0, 5, 6}), row, nullptr).brightness, 16 * 2. / 3, 1e-12);
  EXPECT_EQ(evenVariance(inRegions(base, {0, 0, kNoRegion, kNoRegion}), row, nullptr).brightness, 0);
}

// Six directions in a row. The fourth sees the wall between two windows, which is as bright as elsewhere, or
// a spot on it. Compared with the windows, its difference would be -8.
// Cells in a region add up to its solid angle. At its edge, light is uncertain as far as it differs from the
// mean of the region, as at an edge beside that mean. It counts a third, because it is seen from inside only.
TEST(ErrorEstimate, LightThatDiffersAtTheEdgeOfARegionIsAnError) {
  const auto valueAt = [](size_t x) { return x < 8 ? static_cast<double>(x) : 0; };
  constexpr double kMean = 3.5;
  const Torus beside(16, [&](size_t x, size_t) { return x < 8 ? valueAt(x) - kMean : 0; });
  Torus region(16, [&](size_t x, size_t) { return valueAt(x); });
  for (size_t i = 0; i < region.samples.size(); ++i) region.samples[i].region = i % 16 < 8 ? 1 : 2;
  EXPECT_NEAR(region.variance() / beside.variance(), 1. / 3, .05);
}

TEST(ErrorEstimate, WallsBetweenWindowsAreComparedWithOtherWalls) {
  const Neighbours row{{0, 1, 3, 5, 7, 9, 10}, {1, 0, 2, 1, 3, 2, 4, 3, 5, 4}};
  const auto varianceWith = [&](double between) {
    std::vector<DirectionSample> base;
    for (const double value : {1., 1., 9., between, 9., 9.})
      base.push_back({V3d(0, 0, 1), 1, Radiance(value)});
    return evenVariance(inRegions(base, {0, 0, 5, 0, 6, 6}), row, nullptr).brightness;
  };
  // The direction that is alone in its window is compared with its two neighbours.
  const double alone = std::pow(9 - 1, 2) * 2. / 3;
  EXPECT_NEAR(varianceWith(1), alone, 1e-12);
  const double even = tuning::ErrorEstimate::kEvenSet;
  // The second direction is compared with the first and, in place of the window, with the walls' mean of 2.
  EXPECT_NEAR(varianceWith(4), std::pow(9 - 2.5, 2) * 2. / 3 + even * (9 + .25) * 2 / 3, 1e-12);
}

// One direction that was sent to a window, beside base directions of which two see it.
TEST(ErrorEstimate, ALoneDirectionIsComparedWithItsRegion) {
  const std::vector<DirectionSample> base = inRegions(
      {{V3d(0, 0, 1), 1, Radiance(1)}, {V3d(0, 0, 1), 1, Radiance(8)}, {V3d(0, 0, 1), 1, Radiance(10)}},
      {0, 5, 5});
  const auto varianceIn = [&](RegionId region) {
    DirectionSample lone{V3d(0, 0, 1), 2, Radiance(12)};
    lone.region = region;
    return loneVariance(lone, base, nullptr).brightness;
  };
  EXPECT_NEAR(varianceIn(5), 4 * 9 * 2. / 3, 1e-12);
  EXPECT_NEAR(varianceIn(0), 4 * 121 / 2., 1e-12);
  EXPECT_NEAR(varianceIn(6), 4 * 144, 1e-12);
}

// Three directions that see the same sky through a window of 6 sr, and one that sees the wall.
TEST(ErrorEstimate, SomethingMayHaveBeenMissedInARegion) {
  const std::vector<DirectionSample> samples = {{V3d(0, 0, 1), 2, Radiance(4)},
                                                {V3d(0, 0, 1), 2, Radiance(4)},
                                                {V3d(0, 0, 1), 2, Radiance(4)},
                                                {V3d(0, 0, 1), 2, Radiance(1)}};
  const double missed = tuning::ErrorEstimate::kUnseen * 24 / 4;
  EXPECT_NEAR(unseenVariance(inRegions(samples, {1, 1, 1, 0}), nullptr).brightness, missed * missed, 1e-12);
  EXPECT_EQ(unseenVariance(inRegions(samples, {0, 0, kNoRegion, 0}), nullptr).brightness, 0);
}

}  // namespace
}  // namespace rsphere
