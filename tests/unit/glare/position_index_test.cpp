#include "glare/position_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const Gaze kNorth = *Gaze::upright(V3d(0, 3, 0));

// Of a place as tables have it: how far ahead, above and to the side of the eye.
double indexAt(double ahead, double above, double aside) {
  return positionIndex(V3d(aside, ahead, above).normalized(), kNorth);
}

TEST(PositionIndex, IsOneOnTheLineOfSight) {
  EXPECT_DOUBLE_EQ(positionIndex(V3d(0, 1, 0), kNorth), 1);
  EXPECT_DOUBLE_EQ(positionIndex(V3d(.6, 0, .8), *Gaze::upright(V3d(6, 0, 8))), 1);
}

// Table 4.1 of CIE 117-1995: H/R and T/R are height and distance to the side over the distance ahead. The
// formula is within 12% of Guth's data everywhere (Levin 1975), and within 5% at these.
TEST(PositionIndex, IsThatOfGuthAbove) {
  const struct {
    double height, aside, index;
  } table[] = {{.1, 0, 1.26}, {.2, 0, 1.53},  {.3, 0, 1.90},  {.5, 0, 2.86},   {.7, 0, 4.20},
               {1, 0, 7.00},  {1.2, 0, 9.25}, {1.4, 0, 11.7}, {1.5, 0, 13.15}, {0, .1, 1.05},
               {0, .2, 1.12}, {0, .5, 1.43},  {0, 1, 2.11},   {.5, .5, 2.91},  {1, .5, 6.40}};
  for (const auto& row : table)
    for (const double side : {-1., 1.})
      EXPECT_NEAR(indexAt(1, row.height, side * row.aside), row.index, .05 * row.index)
          << row.height << ' ' << row.aside;
}

// Iwata and Tokura 1997, for sources at R below the line of sight at the distance D ahead: 1 + .8 R/D up to
// R = .6 D, and 1 + 1.2 R/D from there. The formula of 2010 is a smooth one for the same data.
TEST(PositionIndex, IsThatOfIwataBelow) {
  const auto iwata = [](double degrees) {
    const double r = std::tan(degrees * kDegree);
    return 1 + (r < .6 ? .8 : 1.2) * r;
  };
  for (const double degrees : {5., 10., 15., 20., 25., 40., 45., 50.}) {
    const double below = indexAt(std::cos(degrees * kDegree), -std::sin(degrees * kDegree), 0);
    EXPECT_NEAR(below, iwata(degrees), .07 * below) << degrees;
  }
  // By hand: beta = atan(1.15) for 45 degrees straight below.
  EXPECT_NEAR(indexAt(1, -1, 0), std::exp(6.49e-3 * 48.991 + 21e-5 * 48.991 * 48.991), 1e-4);
  EXPECT_NEAR(indexAt(1, -1, 1), std::exp(6.49e-3 * 56.728 + 21e-5 * 56.728 * 56.728), 1e-3);
}

TEST(PositionIndex, HasNoStepAtTheHorizon) {
  for (double aside = .1; aside < 3; aside += .1)
    EXPECT_NEAR(indexAt(1, 1e-9, aside), indexAt(1, -1e-9, aside), 1e-3 * indexAt(1, 0, aside)) << aside;
}

TEST(PositionIndex, IsAtMostSixteen) {
  EXPECT_EQ(indexAt(.1, 1, 0), 16);
  EXPECT_EQ(indexAt(0, 1, 0), 16);
  EXPECT_LT(indexAt(1, 1.5, 0), 16);
}

// A gaze that is tilted or turned has the same field of view.
TEST(PositionIndex, TurnsWithTheGaze) {
  const double tilt = 30 * kDegree;
  const Gaze tilted = *Gaze::upright(V3d(0, std::cos(tilt), std::sin(tilt)));
  const V3d up(0, -std::sin(tilt), std::cos(tilt));
  EXPECT_NEAR((tilted.up - up).length(), 0, 1e-15);
  const V3d seen = (tilted.direction + .4 * up + V3d(.3, 0, 0)).normalized();
  EXPECT_NEAR(positionIndex(seen, tilted), indexAt(1, .4, .3), 1e-12);
  const Gaze east = *Gaze::upright(V3d(2, 0, 0));
  EXPECT_NEAR(positionIndex(V3d(1, -.3, .4).normalized(), east), indexAt(1, .4, .3), 1e-12);
}

TEST(Gaze, IsNotVertical) {
  EXPECT_FALSE(Gaze::upright(V3d(0, 0, 0)));
  EXPECT_FALSE(Gaze::upright(V3d(0, 0, 2)));
  EXPECT_FALSE(Gaze::upright(V3d(0, 0, -1e300)));
  EXPECT_FALSE(Gaze::upright(V3d(1e-7, 0, 1)));
  EXPECT_FALSE(Gaze::upright(V3d(std::nan(""), 1, 0)));
  EXPECT_FALSE(Gaze::upright(V3d(INFINITY, 1, 0)));
  EXPECT_TRUE(Gaze::upright(V3d(1e-5, 0, 1)));
  EXPECT_TRUE(Gaze::upright(V3d(0, 1e-300, 0)));
  EXPECT_TRUE(Gaze::upright(V3d(0, 1e300, 1e300)));
}

}  // namespace
}  // namespace rsphere
