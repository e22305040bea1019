#include "glare/nearby_directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/glare/random_directions.h"

namespace rsphere {
namespace {

double angleBetween(const V3d& a, const V3d& b) { return 2 * std::asin((a - b).length() / 2); }

TEST(NearbyDirections, AreThoseOfAllPairs) {
  const std::vector<V3d> directions = randomDirections(500, 1);
  for (const double angle : {.01, .1, .3, 1., 3.}) {
    const NearbyDirections nearby(directions, angle);
    for (const V3d& direction : randomDirections(20, 2)) {
      std::vector<size_t> found, expected;
      NearbyDirections left = nearby;
      left.takeNear(direction, found);
      for (size_t i = 0; i < directions.size(); ++i)
        if (angleBetween(directions[i], direction) <= angle) expected.push_back(i);
      std::ranges::sort(found);
      EXPECT_EQ(found, expected) << angle;
    }
  }
}

TEST(NearbyDirections, AreTakenOnce) {
  const std::vector<V3d> directions = randomDirections(200, 3);
  NearbyDirections left(directions, .5);
  std::vector<size_t> taken;
  for (const V3d& direction : directions) left.takeNear(direction, taken);
  std::ranges::sort(taken);
  ASSERT_EQ(taken.size(), directions.size());
  for (size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i], i);
}

// A chain of small steps is one group; a gap divides it.
TEST(ConnectedGroups, AreChains) {
  std::vector<V3d> directions;
  for (int i = 0; i < 60; ++i)
    if (i != 20 && i != 21) directions.emplace_back(std::cos(.05 * i), std::sin(.05 * i), 0);
  const std::vector<size_t> one = connectedGroups(directions, .16), two = connectedGroups(directions, .06);
  EXPECT_EQ(one, std::vector<size_t>(directions.size(), 0));
  for (size_t i = 0; i < two.size(); ++i) EXPECT_EQ(two[i], i < 20 ? 0 : 1) << i;
  EXPECT_TRUE(connectedGroups({}, .1).empty());
}

// Two groups are never near each other, whatever the order.
TEST(ConnectedGroups, OfRandomDirections) {
  const std::vector<V3d> directions = randomDirections(300, 4);
  constexpr double kAngle = .12;
  const std::vector<size_t> groups = connectedGroups(directions, kAngle);
  for (size_t i = 0; i < directions.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      EXPECT_TRUE(groups[i] == groups[k] || angleBetween(directions[i], directions[k]) > kAngle);
  const size_t count = *std::ranges::max_element(groups) + 1;
  EXPECT_GT(count, 10);
  EXPECT_LT(count, 250);
}

}  // namespace
}  // namespace rsphere
