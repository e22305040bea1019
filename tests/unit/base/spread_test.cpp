#include "tests/unit/support/spread.h"

#include <gtest/gtest.h>

namespace rsphere {
namespace {

TEST(Spread, IsMeanAndVariance) {
  Spread spread;
  for (const double x : {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}) spread.add(x);
  EXPECT_DOUBLE_EQ(spread.mean(), 1e9 + 10);
  EXPECT_DOUBLE_EQ(spread.variance(), 30);
  EXPECT_DOUBLE_EQ(spread.standardError(), std::sqrt(7.5));
}

}  // namespace
}  // namespace rsphere
