#include "sphere/direction_bins.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace rsphere {
namespace {

using std::numbers::pi;

// Thirds of the upper half by azimuth; the lower half is in none.
size_t third(const V3d& d) {
  if (d.z < 0) return 99;
  const double turn = std::atan2(d.y, d.x) / (2 * pi);
  return static_cast<size_t>(3 * (turn < 0 ? turn + 1 : turn));
}

TEST(DirectionBins, HaveTheSolidAnglesOfTheirFunction) {
  const DirectionBins bins(4, third);
  EXPECT_EQ(bins.count(), 4);
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(bins.solidAngle(i), 2 * pi / 3, 1e-4);
  EXPECT_EQ(bins.solidAngle(3), 0);
  EXPECT_EQ(bins.binAt(V3d(.6, .48, .64)), 0);
  EXPECT_EQ(bins.binAt(V3d(-.6, -.48, .64)), 1);
  EXPECT_EQ(bins.binAt(V3d(.6, -.48, .64)), 2);
  EXPECT_EQ(bins.binAt(V3d(.6, .48, -.64)), 4);
}

TEST(DirectionBins, AreZonesWithoutAFunction) {
  const DirectionBins bins(33);
  const EqualZones zones(33);
  for (size_t i = 0; i < 33; ++i) {
    EXPECT_EQ(bins.binAt(zones.middle(i)), i);
    EXPECT_EQ(bins.solidAngle(i), zones.solidAngle());
  }
}

TEST(DirectionBins, DivideCells) {
  const DirectionBins bins(3, third);
  const auto shares = [&](const V3d& direction, double solidAngle) {
    std::map<size_t, double> found;
    bins.divide(direction.normalized(), solidAngle, [&](size_t bin, double share) { found[bin] += share; });
    return found;
  };
  EXPECT_EQ(shares(V3d(.6, .48, .64), .01), (std::map<size_t, double>{{0, 1.}}));
  EXPECT_EQ(shares(V3d(.6, .48, -.64), .01), (std::map<size_t, double>{}));
  // On the border between two bins each has about a half, and on the horizon a bin has half of the cell.
  const auto between = shares(V3d(1, 1e-4, 1), .01);
  ASSERT_EQ(between.size(), 2);
  EXPECT_NEAR(between.at(0) + between.at(2), 1, 1e-12);
  EXPECT_NEAR(between.at(0), .5, .25);
  const auto half = shares(V3d(1, 1, 1e-4), .01);
  ASSERT_EQ(half.size(), 1);
  EXPECT_NEAR(half.at(0), .5, .25);
}

}  // namespace
}  // namespace rsphere
