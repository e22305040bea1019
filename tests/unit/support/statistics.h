#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "base/color.h"
#include "base/random.h"
#include "tests/unit/support/spread.h"

namespace rsphere {

// Beyond this many standard errors a figure is called wrong: a right one gets there once in 16,000 seeds, and
// seeds are fixed.
inline constexpr double kMostSigmas = 4;

// Mean of independent values, as tests compare it.
class Sample : public Spread {
 public:
  // Not below the rounding of the sum: values that do not vary are compared to that.
  double standardError() const { return std::max(Spread::standardError(), 1e-12 * std::abs(mean())); }
  double sigmas(double expected) const { return (mean() - expected) / standardError(); }
};

// That the mean is the expected one, and that this test would have told it from one that is off by the
// spoiled factor.
inline void expectMean(const Sample& sample, double expected, double spoiled = 1.05) {
  EXPECT_LT(std::abs(sample.sigmas(expected)), kMostSigmas)
      << "mean " << sample.mean() << " +- " << sample.standardError() << ", expected " << expected;
  EXPECT_GT(std::abs(sample.sigmas(spoiled * expected)), kMostSigmas)
      << "the sample is too small to see an error of " << spoiled << " of " << expected << ": mean "
      << sample.mean() << " +- " << sample.standardError();
}

// How many standard deviations a chi-squared statistic lies above its mean, as a normal deviate (Wilson and
// Hilferty 1931; right to 0.01 for more than 30 degrees of freedom).
inline double chiSquaredSigmas(double statistic, double degrees) {
  const double v = 2 / (9 * degrees);
  return (std::cbrt(statistic / degrees) - (1 - v)) / std::sqrt(v);
}

// The same for counts in cells against their expected numbers; cells of fewer than 5 expected are pooled.
inline double chiSquaredSigmas(std::span<const double> counts, std::span<const double> expected) {
  double statistic = 0, pooledCount = 0, pooledExpected = 0;
  int cells = 0;
  const auto addCell = [&](double count, double mean) {
    statistic += (count - mean) * (count - mean) / mean;
    ++cells;
  };
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= 5) {
      addCell(counts[i], expected[i]);
    } else {
      pooledCount += counts[i];
      pooledExpected += expected[i];
    }
  }
  if (pooledExpected >= 5) addCell(pooledCount, pooledExpected);
  return chiSquaredSigmas(statistic, cells - 1);
}

inline double between(Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

inline V3d randomDirection(Random& random) {
  const double z = between(random, -1, 1), angle = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(1 - z * z);
  return V3d(r * std::cos(angle), r * std::sin(angle), z).normalized();
}

inline V3d randomPoint(Random& random, double halfSize) {
  return V3d(between(random, -halfSize, halfSize), between(random, -halfSize, halfSize),
             between(random, -halfSize, halfSize));
}

}  // namespace rsphere
