#include "image/rgbe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace rsphere {
namespace {

TEST(Rgbe, KnownPixels) {
  using Pixel = std::array<uint8_t, 4>;
  EXPECT_EQ(rgbePixel(Color(1, 1, 1)), (Pixel{128, 128, 128, 129}));
  EXPECT_EQ(rgbePixel(Color(.5, .25, 0)), (Pixel{128, 64, 0, 128}));
  EXPECT_EQ(rgbePixel(Color(0, 0, 0)), (Pixel{0, 0, 0, 0}));
  EXPECT_EQ(rgbePixel(Color(-1, 2, -3)), (Pixel{0, 128, 0, 130}));
  EXPECT_EQ(rgbePixel(Color(.99e-32, 0, 0)), (Pixel{0, 0, 0, 0}));
  // echo 0 0 0 0 0 1 | rtrace -h -fac (6.1a), where the sky is a glow of this radiance.
  EXPECT_EQ(rgbePixel(Color(.1, .7, 12.3)), (Pixel{1, 11, 196, 132}));
  EXPECT_EQ(rgbePixel(Color(.99999, 1e-3, 1e-9)), (Pixel{255, 0, 0, 128}));
  EXPECT_EQ(rgbePixel(Color(123456, 3, 99999)), (Pixel{241, 0, 195, 145}));
}

TEST(Rgbe, MantissasAreRoundedDownAndTheLargestIsAtLeastHalf) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (int i = 0; i < 100000; ++i) {
    const Color c(std::pow(10, exponent(random)), std::pow(10, exponent(random)),
                  std::pow(10, exponent(random)));
    const auto pixel = rgbePixel(c);
    const double unit = std::ldexp(1.0, pixel[3] - 128 - 8);
    EXPECT_GE(std::max({pixel[0], pixel[1], pixel[2]}), 128);
    for (int k = 0; k < 3; ++k) {
      const auto single = static_cast<double>(static_cast<float>(c[k]));
      ASSERT_LE(pixel[k] * unit, single);
      ASSERT_GT((pixel[k] + 1) * unit, single);
    }
  }
}

TEST(Rgbe, NothingOverflows) {
  using Pixel = std::array<uint8_t, 4>;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(rgbePixel(Color(1e300, 0, 0)), (Pixel{255, 255, 255, 255}));
  EXPECT_EQ(rgbePixel(Color(infinity, 1, 1)), (Pixel{255, 255, 255, 255}));
  EXPECT_EQ(rgbePixel(Color(std::nan(""), 0, 1)), (Pixel{0, 0, 128, 129}));
}

}  // namespace
}  // namespace rsphere
