#include "companions/measure/statistics.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"

namespace rsphere {
namespace {

// For one and two degrees of freedom there are closed forms.
TEST(BeyondT, IsTheClosedForm) {
  for (const double t : {0., .1, 1., 3., 20.}) {
    EXPECT_NEAR(beyondT(t, 1), 1 - 2 / std::numbers::pi * std::atan(t), 1e-14) << t;
    EXPECT_NEAR(beyondT(-t, 2), 1 - t / std::sqrt(2 + t * t), 1e-14) << t;
  }
}

// Values from tables of Student's distribution, two-sided.
TEST(BeyondT, IsThatOfTables) {
  EXPECT_NEAR(beyondT(2.2281, 10), .05, 1e-5);
  EXPECT_NEAR(beyondT(4.1403, 14), .001, 1e-6);
  EXPECT_NEAR(beyondT(3.5518, 7), .00932, 1e-4);
  EXPECT_NEAR(beyondT(1.9720, 199), .05, 1e-4);
  EXPECT_NEAR(beyondT(1.9600, 201), .05, 1e-4);
  EXPECT_EQ(beyondT(3, 0), 1);
}

TEST(ChanceOf, WithoutNoiseIsCertain) {
  EXPECT_EQ(chanceOf(0, 0, 8), 1);
  EXPECT_EQ(chanceOf(1e-9, 0, 8), 0);
  EXPECT_EQ(chanceOf(2, 1, 8), beyondT(2, 8));
}

TEST(Spread, IsMeanAndVariance) {
  Spread spread;
  for (const double x : {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}) spread.add(x);
  EXPECT_DOUBLE_EQ(spread.mean(), 1e9 + 10);
  EXPECT_DOUBLE_EQ(spread.variance(), 30);
  EXPECT_DOUBLE_EQ(spread.standardError(), std::sqrt(7.5));
}

}  // namespace
}  // namespace rsphere
