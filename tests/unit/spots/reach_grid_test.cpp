#include "spots/reach_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace rsphere {
namespace {

double distanceTo(const ReachGrid::Reach& reach, const V3d& point) {
  double nearest = (point - reach.end).length();
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i)
    nearest = std::min(nearest, (point - reach.begin - (reach.end - reach.begin) * i / kSteps).length());
  return nearest;
}

TEST(ReachGrid, FindsAllThatReachAPointAndFewOthers) {
  const Box3d bounds(V3d(-1, 2, 0), V3d(7, 6, 3));
  Random random(1);
  const auto place = [&] {
    return bounds.min + V3d(random.uniform(), random.uniform(), random.uniform()) * bounds.size();
  };
  std::vector<ReachGrid::Reach> reaches;
  for (int i = 0; i < 40; ++i) reaches.push_back({place(), place(), random.uniform()});
  for (int i = 0; i < 40; ++i) reaches.push_back({reaches[i].begin, reaches[i].begin, 1e-3});
  const ReachGrid grid(reaches, bounds);
  int found = 0, reaching = 0;
  for (int i = 0; i < 300; ++i) {
    const V3d point = place();
    const auto at = grid.at(point);
    EXPECT_TRUE(std::ranges::is_sorted(at));
    for (uint32_t k = 0; k < reaches.size(); ++k) {
      const bool near = distanceTo(reaches[k], point) < reaches[k].distance - .01;
      const bool is = std::ranges::find(at, k) != at.end();
      EXPECT_TRUE(is || !near) << k;
      found += is;
      reaching += near;
    }
  }
  EXPECT_GT(reaching, 300);
  EXPECT_LT(found, 2 * reaching);
}

TEST(ReachGrid, HasNothingOfNothing) {
  EXPECT_TRUE(ReachGrid().at(V3d(1, 2, 3)).empty());
  EXPECT_TRUE(ReachGrid({}, Box3d(V3d(0), V3d(1))).at(V3d(.5)).empty());
}

// Points outside the bounds are answered as the nearest ones inside, and bounds may be flat.
TEST(ReachGrid, TakesAnyPoint) {
  const ReachGrid flat({{V3d(1, 1, 0), V3d(1, 1, 0), .1}}, Box3d(V3d(0), V3d(2, 2, 0)));
  EXPECT_EQ(flat.at(V3d(1, 1, 5)).size(), 1u);
  EXPECT_EQ(flat.at(V3d(1e9, -1e9, 0)).size(), 0u);
  const ReachGrid one({{V3d(1), V3d(1), .1}}, Box3d(V3d(1), V3d(1)));
  EXPECT_EQ(one.at(V3d(3)).size(), 1u);
}

}  // namespace
}  // namespace rsphere
