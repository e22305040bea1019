#include "light/penumbra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace rsphere {
namespace {

V3d anywhere(Random& random) { return V3d(random.uniform(), random.uniform(), random.uniform()); }

// A triangle of about this size.
std::vector<V3d> triangle(const V3d& center, double size, Random& random) {
  std::vector<V3d> corners;
  for (int i = 0; i < 3; ++i) corners.push_back(center + size * (anywhere(random) - V3d(.5, .5, .5)));
  return corners;
}
V3d pointIn(const std::vector<V3d>& triangle, Random& random) {
  const double a = std::sqrt(random.uniform()), b = random.uniform();
  return (1 - a) * triangle[0] + a * (1 - b) * triangle[1] + a * b * triangle[2];
}

TEST(Penumbra, HoldsAllLightBehindTheOpeningAndLittleElse) {
  Random random(3);
  size_t outside = 0, all = 0;
  for (int i = 0; i < 300; ++i) {
    const auto from = triangle(V3d(0, 0, 0), 1, random), opening = triangle(V3d(0, 0, 2), 1, random);
    std::vector<HalfSpace> bounds;
    addPenumbra(from, opening, bounds);
    EXPECT_GE(bounds.size(), 3u);
    const auto lowest = [&](const V3d& p) {
      double least = 1e9;
      for (const HalfSpace& b : bounds) least = std::min(least, b.height(p));
      return least;
    };
    for (int k = 0; k < 100; ++k) {
      const V3d start = pointIn(from, random), through = pointIn(opening, random);
      EXPECT_GE(lowest(through + 5 * random.uniform() * (through - start)), -1e-9);
      // The beam of both spheres holds all points of this square.
      outside += lowest(V3d(4 * random.uniform() - 2, 4 * random.uniform() - 2, 4)) < -.01;
      ++all;
    }
  }
  EXPECT_GT(outside, all / 2);
}

TEST(Penumbra, OfHullsThatOverlapIsEverywhere) {
  const std::vector<V3d> from{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, across{{0, 0, -1}, {0, .2, 1}, {.1, 0, 1}};
  std::vector<HalfSpace> bounds;
  addPenumbra(from, across, bounds);
  EXPECT_TRUE(bounds.empty());
}

TEST(Penumbra, ClippedIsThePartInside) {
  const std::vector<V3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto part = clipped(square, std::vector<HalfSpace>{{V3d(1, 0, 0), .25}, {V3d(0, -1, 0), -.5}});
  Box3d box;
  for (const V3d& p : part) box.extendBy(p);
  EXPECT_EQ(part.size(), 4u);
  EXPECT_LT((box.min - V3d(.25, 0, 0)).length(), 1e-6);
  EXPECT_LT((box.max - V3d(1, .5, 0)).length(), 1e-6);
  EXPECT_TRUE(clipped(square, std::vector<HalfSpace>{{V3d(1, 0, 0), 1.01}}).empty());
  EXPECT_TRUE(isOutside(box, {V3d(0, 1, 0), .51}));
  EXPECT_FALSE(isOutside(box, {V3d(0, 1, 0), .49}));
}

}  // namespace
}  // namespace rsphere
