#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "base/band_scheme.h"
#include "base/color.h"
#include "base/spectral_sampling.h"

namespace rsphere {
namespace {

constexpr size_t kMany = 40;  // more than the usual room of a block has values for

Color partOf(size_t contributor, const V3d& rgb, size_t contributors = kMany) {
  return Color::ofContributor(rgb, contributor, partsOf(contributors));
}

TEST(Parts, OfOneContributorAreTheColorAndNoneElse) {
  const Color color = partOf(7, V3d(1, 2, 3));
  EXPECT_EQ(color.rgb(), V3d(1, 2, 3));
  EXPECT_EQ(color.part(7), Color(1, 2, 3));
  EXPECT_EQ(color.part(6), Color(0));
  EXPECT_EQ(color.part(8), Color(0));
  EXPECT_EQ(color.part(kMany + 5), Color(0));
  EXPECT_EQ(Color(1, 2, 3).part(0), Color(0));
}

TEST(Parts, AddUpInAnyOrder) {
  for (const auto& [first, second] : {std::pair<size_t, size_t>{3, 30}, {30, 3}, {3, 4}, {4, 3}, {5, 5}}) {
    Color sum = partOf(first, V3d(1, 2, 3));
    sum += partOf(second, V3d(10, 20, 30));
    sum -= partOf(first, V3d(.5, .5, .5));
    EXPECT_EQ(sum.rgb(), V3d(10.5, 21.5, 32.5));
    Color found(0);
    for (size_t i = 0; i < kMany; ++i) found += sum.part(i);
    EXPECT_EQ(found, Color(sum.rgb())) << first << ' ' << second;
    if (first != second) {
      EXPECT_EQ(sum.part(first), Color(.5, 1.5, 2.5));
      EXPECT_EQ(sum.part(second), Color(10, 20, 30));
    }
  }
}

TEST(Parts, ASpectrumOrNoContributorAddsNothingToThem) {
  Color sum = Color(1, 1, 1) + partOf(2, V3d(1, 2, 3));
  sum += Color(5, 5, 5);
  EXPECT_EQ(sum.rgb(), V3d(7, 8, 9));
  EXPECT_EQ(sum.part(2), Color(1, 2, 3));
  EXPECT_EQ(sum.part(0), Color(0));
}

TEST(Parts, AFactorAppliesToAllOfThem) {
  const Color sum = partOf(1, V3d(1, 2, 3)) + partOf(39, V3d(4, 5, 6)), factor(.5, .25, 2);
  for (Color product : {sum * factor, factor * sum}) {
    EXPECT_EQ(product.rgb(), V3d(2.5, 1.75, 18));
    EXPECT_EQ(product.part(1), Color(.5, .5, 6));
    EXPECT_EQ(product.part(39), Color(2, 1.25, 12));
    product *= 2;
    product /= Color(1, 2, 4);
    EXPECT_EQ(product.part(39), Color(4, 1.25, 6));
    EXPECT_EQ(product.part(20), Color(0));
  }
  Color scaled = factor;
  scaled *= sum;
  EXPECT_EQ(scaled, sum * factor);
  Color added(0);
  added.addProduct(sum, factor);
  added.addProduct(sum, factor, 2, .5);
  added.addScaled(sum * factor, -1);
  EXPECT_EQ(added, sum * factor);
}

// As squares of errors need it.
TEST(Parts, OfProductsOfPartsAreThoseThatBothHave) {
  const Color a = partOf(1, V3d(1, 2, 3)) + partOf(4, V3d(4, 5, 6)), b = partOf(4, V3d(2, 2, 2));
  EXPECT_EQ((a * b).part(4), Color(8, 10, 12));
  EXPECT_EQ((a * b).part(1), Color(0));
  EXPECT_EQ((a * a).part(1), Color(1, 4, 9));
  EXPECT_EQ((b * partOf(1, V3d(1, 1, 1))).part(1), Color(0));
}

TEST(Parts, DecisionsAreThoseOfTheirSum) {
  const Color sum = partOf(0, V3d(1, 2, 3)) + partOf(1, V3d(4, 5, 6));
  EXPECT_EQ(maxChannel(sum), 9);
  EXPECT_EQ(minChannel(sum), 5);
  EXPECT_FALSE(isBlack(sum));
  EXPECT_TRUE(isBlack(sum - sum));
}

TEST(Parts, CopiesAreIndependentAndFunctionsSeeAllParts) {
  const Color sum = partOf(0, V3d(1, 4, 9)) + partOf(35, V3d(16, 25, 36));
  Color copy = partOf(3, V3d(1, 1, 1));
  copy = sum;
  copy.transform([](double v) { return std::sqrt(v); });
  EXPECT_EQ(copy.part(35), Color(4, 5, 6));
  EXPECT_EQ(sum.part(35), Color(16, 25, 36));
  EXPECT_EQ(combined(sum, copy, [](double a, double b) { return a - b * b; }).part(35), Color(0));
  copy = Color(1, 2, 3);
  EXPECT_EQ(copy, Color(1, 2, 3));
  EXPECT_FALSE(sum == Color(sum.rgb()));
}

// Answers are made by threads of their own and destroyed by that which asked for
// them, which kept the memory of all: gigabytes after a layout.
TEST(Parts, OfOtherThreadsReturnTheirMemory) {
  const auto pass = [](int times) {
    for (int i = 0; i < times; ++i) {
      std::vector<Color> colors;
      std::thread([&] {
        for (size_t k = 0; k < 20000; ++k) colors.push_back(partOf(k % kMany, V3d(1, 2, 3)));
      }).join();
    }
    return mallinfo2().uordblks;
  };
  const size_t before = pass(2);
  EXPECT_LT(pass(30), before + (4 << 20));  // 32 MB of colors have passed
}

}  // namespace
}  // namespace rsphere
