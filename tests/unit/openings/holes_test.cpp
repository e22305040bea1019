#include "openings/holes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "openings/tuning.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere::holes_test {
namespace {

const std::string kGray = "void plastic gray 0 0 5 .5 .5 .5 0 0\n";
// A wall in the plane y = 0, 6.4 m wide and 3.2 m high, so that a cell of the grid has 10 x 5 cm.
constexpr double kWidth = 6.4, kHeight = 3.2;

// A rectangle in a plane of constant y.
std::string upright(const std::string& name, double y, double x0, double z0, double x1, double z1) {
  return fmt::format("gray polygon {0} 0 0 12 {2} {1} {3} {4} {1} {3} {4} {1} {5} {2} {1} {5}\n", name, y, x0,
                     z0, x1, z1);
}

std::vector<Rectangle> holesIn(const std::string& text, double leastArea = .01) {
  Traced t(kGray + text, {});
  const auto any = [](const Surface&) { return true; };
  return holesOf(t.scene(), t.prepared().tracer().bounds(), leastArea, any);
}

// That the rectangle is the one between two corners.
void expectBetween(const Rectangle& hole, const V3d& low, const V3d& high, double tolerance = 1e-9) {
  Box3d bounds;
  for (int c = 0; c < 4; ++c) bounds.extendBy(hole.at(c & 1, c >> 1));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(bounds.min[c], low[c], tolerance) << c;
    EXPECT_NEAR(bounds.max[c], high[c], tolerance) << c;
  }
}

// A polygon with holes in it has a seam: an edge from its outline to each hole and back.
TEST(Holes, AreWithinOnePolygon) {
  const auto found = holesIn(
      "gray polygon wall 0 0 30 0 0 0 6.4 0 0 6.4 0 3.2 0 0 3.2 0 0 0 1 0 1 1 0 2 3 0 2 3 0 1 1 0 1\n");
  ASSERT_EQ(found.size(), 1u);
  expectBetween(found[0], {1, 0, 1}, {3, 0, 2});
  // Between the lines of the grid.
  const auto odd = holesIn(
      "gray polygon wall 0 0 30 0 0 0 6.4 0 0 6.4 0 3.2 0 0 3.2 0 0 0 1.03 0 1.01 1.03 0 2.04 3.07 0 2.04 "
      "3.07 0 "
      "1.01 1.03 0 1.01\n");
  ASSERT_EQ(odd.size(), 1u);
  expectBetween(odd[0], {1.03, 0, 1.01}, {3.07, 0, 2.04});
}

// A round hole has no corner at each of its sides: there, its rectangle ends with cells of the grid.
TEST(Holes, AreRoundToWithinACell) {
  std::string wall = "gray polygon wall 0 0 93 0 0 0 6.4 0 0 6.4 0 3.2 0 0 3.2 0 0 0";
  const int sides = 25;
  for (int i = 0; i <= sides; ++i)
    wall += fmt::format(" {} 0 {}", 3 + .8 * std::sin(2 * kPi * i / sides),
                        1.6 + .8 * std::cos(2 * kPi * i / sides));
  const auto found = holesIn(wall + "\n");
  ASSERT_EQ(found.size(), 1u);
  expectBetween(found[0], {2.2, 0, .8}, {3.8, 0, 2.4}, kWidth / tuning::Holes::kCells);
}

TEST(Holes, AreBetweenPolygonsLargestFirst) {
  const std::string wall = upright("west", 0, 0, 0, 1, kHeight) + upright("middle", 0, 2, 0, 4, kHeight) +
                           upright("east", 0, 4.5, 0, kWidth, kHeight) +
                           upright("lintel", 0, 1, 2, 2, kHeight) +
                           upright("above", 0, 4, 1.8, 4.5, kHeight) + upright("below", 0, 4, 0, 4.5, 1);
  const auto found = holesIn(wall);
  ASSERT_EQ(found.size(), 2u);
  expectBetween(found[0], {1, 0, 0}, {2, 0, 2});
  expectBetween(found[1], {4, 0, 1}, {4.5, 0, 1.8});
  EXPECT_EQ(holesIn(wall, .45).size(), 1u) << "the window has .4 square metres";
  const auto rotated = holesIn(
      "gray polygon a 0 0 12 0 0 0 0 0 1 3 3 1 3 3 0\n"
      "gray polygon b 0 0 12 0 0 2 0 0 3 3 3 3 3 3 2\n"
      "gray polygon c 0 0 12 0 0 1 0 0 2 1 1 2 1 1 1\n"
      "gray polygon d 0 0 12 2 2 1 3 3 1 3 3 2 2 2 2\n");
  ASSERT_EQ(rotated.size(), 1u) << "one polygon faces the other way";
  EXPECT_NEAR(rotated[0].area(), std::sqrt(2), .1);
  EXPECT_LT((rotated[0].at(.5, .5) - V3d(1.5, 1.5, 1.5)).length(), .1);
}

// Neither the space between the legs of desks nor between walls that are far apart is a hole.
TEST(Holes, EndWithAWallOnMostSides) {
  std::string legs;
  for (int i = 0; i < 6; ++i) legs += upright(fmt::format("leg{}", i), 0, i, 0, i + .3, .7);
  EXPECT_TRUE(holesIn(legs).empty());
  EXPECT_TRUE(holesIn(upright("a", 0, 0, 0, 1, kHeight) + upright("b", 0, 6, 0, kWidth, kHeight)).empty());
  EXPECT_TRUE(holesIn("gray polygon notched 0 0 18 0 0 0 6 0 0 6 0 1 1 0 1 1 0 3 0 0 3\n").empty());
  EXPECT_TRUE(holesIn(upright("whole", 0, 0, 0, kWidth, kHeight)).empty());
  EXPECT_TRUE(holesIn("gray polygon point 0 0 9 0 0 0 0 0 0 0 0 0\n").empty());
}

TEST(Holes, AreInEachPlaneByItself) {
  std::string walls;
  for (const double y : {0., .2})
    walls += upright("west", y, 0, 0, 1, kHeight) + upright("east", y, 2, 0, kWidth, kHeight) +
             upright("lintel", y, 1, 2, 2, kHeight);
  EXPECT_EQ(holesIn(walls).size(), 2u) << "both faces of a thick wall have the doorway";
  Traced t(kGray + "void glass clear 0 0 3 .9 .9 .9\n" + walls +
               "clear polygon pane 0 0 12 1 .2 0 2 .2 0 2 .2 2 1 .2 2\n",
           {});
  const auto holes = [&](auto isWall) {
    return holesOf(t.scene(), t.prepared().tracer().bounds(), .01, isWall).size();
  };
  EXPECT_EQ(holes([](const Surface&) { return true; }), 1u) << "a pane as a part of the wall closes it";
  EXPECT_EQ(holes([&](const Surface& s) { return t.scene().surfaceName(s) != "pane"; }), 2u);
  EXPECT_EQ(holes([](const Surface&) { return false; }), 0u);
}

}  // namespace
}  // namespace rsphere::holes_test
