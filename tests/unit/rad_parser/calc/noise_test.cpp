#include "rad_parser/calc/noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rad::calc {
namespace {

TEST(CalcMath, NoiseIsSmoothAndBounded) {
  for (int i = -300; i < 300; ++i) {
    const double x = i * .37, y = i * -.11, z = i * .53;
    EXPECT_EQ(noise3(i, 2 * i, -i), 0);
    EXPECT_LE(std::abs(noise3(x, y, z)), 1);
    EXPECT_NEAR(noise3(x, y, z), noise3(x + 256, y - 512, z), 1e-10);
    // Value and slope are continuous across the faces of cells.
    const double step = 1e-5;
    EXPECT_NEAR(noise3(i - step, y, z), 2 * noise3(i, y, z) - noise3(i + step, y, z), 1e-8);
  }
  for (double far : {3e9, -3e9, 1e300, HUGE_VAL}) {
    EXPECT_EQ(noise3(far, 0, .5), 0);
    EXPECT_TRUE(std::isfinite(fractalNoise3(.5, far, 0)));
  }
}

}  // namespace
}  // namespace rad::calc
