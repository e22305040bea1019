#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/constants.h"
#include "shade/scattering.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {

// A ray that comes down in the plane of x and z.
inline Interaction arriving(double cosine) {
  Interaction at;
  at.cosine = cosine;
  at.direction = V3d(std::sqrt(1 - cosine * cosine), 0, -cosine);
  return at;
}

// How many standard deviations chi-squared is off for the counts of sampled directions in cells about a
// lobe's middle. draw: a direction for two uniform numbers; not above 0 where it is lost. density: of
// directions, per sr, 0 where there are none. widest: half the chord from the middle that the cells reach to;
// what is farther, or lost, is a cell of its own.
template <class Draw, class Density>
double samplingSigmas(const V3d& middle, double widest, uint64_t seed, const Draw& draw,
                      const Density& density) {
  constexpr int kRows = 40, kColumns = 24, kFine = 24;
  std::vector<double> counts(kRows * kColumns + 1, 0.), expected(kRows * kColumns + 1, 0.);
  const auto [x, y] = frame(middle);
  const auto cellOf = [&, x = x, y = y](const V3d& d) {
    const double c = std::sqrt(std::max(0., (1 - d.dot(middle)) / 2));
    if (c >= widest) return kRows * kColumns;
    const int row = std::min(kRows - 1, static_cast<int>(c / widest * kRows));
    const double turn = std::atan2(d.dot(y), d.dot(x)) / (2 * kPi) + .5;
    return row * kColumns + std::min(kColumns - 1, static_cast<int>(turn * kColumns));
  };
  constexpr int kSamples = 200000;
  Random random(seed);
  for (int i = 0; i < kSamples; ++i) {
    V3d d;
    const double u1 = random.uniform(), u2 = random.uniform();
    ++counts[draw(u1, u2, d) > 0 ? cellOf(d) : kRows * kColumns];
  }
  double total = 0;
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kFine; ++i) {
      const double c = widest * (row + (i + .5) / kFine) / kRows;
      const double cosine = 1 - 2 * c * c, sine = std::sqrt(std::max(0., 1 - cosine * cosine));
      // d(cosine) = 4 c dc
      const double omega = 4 * c * widest / (kRows * kFine) * 2 * kPi / (kColumns * kFine);
      for (int k = 0; k < kColumns * kFine; ++k) {
        const double angle = ((k + .5) / (kColumns * kFine) - .5) * 2 * kPi;
        const V3d d = cosine * middle + sine * (std::cos(angle) * x + std::sin(angle) * y);
        const double n = kSamples * density(d) * omega;
        expected[row * kColumns + k / kFine] += n;
        total += n;
      }
    }
  expected.back() = std::max(0., kSamples - total);
  return chiSquaredSigmas(counts, expected);
}

}  // namespace rsphere
