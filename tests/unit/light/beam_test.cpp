#include "light/beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/random.h"

namespace rsphere {
namespace {

V3d direction(Random& random) {
  for (;;) {
    const V3d v(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
    if (v.length() > .1 && v.length() < 1) return v.normalized();
  }
}
V3d near(const V3d& point, double distance, Random& random) {
  return point + distance * std::sqrt(random.uniform()) * direction(random);
}
bool holds(const Beam& beam, const V3d& direction, double slack) {
  return direction.dot(beam.axis) >= beam.cosine - slack;
}

TEST(Beam, SharedHoldsWhatBothHoldAndIsNoWider) {
  Random random(7);
  size_t shared = 0, crossing = 0;
  for (int i = 0; i < 2000; ++i) {
    const Beam a{direction(random), 2 * random.uniform() - 1};
    const Beam b{near(a.axis, 1.5, random).normalized(), 2 * random.uniform() - 1};
    const Beam both = sharedBeam(a, b);
    EXPECT_NEAR(both.axis.length(), 1, 1e-12);
    EXPECT_GE(both.cosine, std::max(a.cosine, b.cosine) - 1e-12);
    crossing += both.cosine > std::max(a.cosine, b.cosine) + 1e-6 && both.cosine < 1;
    for (int k = 0; k < 100; ++k) {
      const V3d d = direction(random);
      if (!holds(a, d, 0) || !holds(b, d, 0)) continue;
      ++shared;
      EXPECT_TRUE(holds(both, d, 1e-12)) << i;
    }
  }
  EXPECT_GT(shared, 10000u);
  EXPECT_GT(crossing, 100u);
}

// Two beams of 40 and 30 degrees, 45 degrees apart: their surfaces cross in two directions, which lie on the
// surface of what they share.
TEST(Beam, SharedIsAsNarrowAsTheDirectionsInWhichTheyCross) {
  const double a = 40 * kPi / 180, b = 30 * kPi / 180, between = 45 * kPi / 180;
  const Beam first{V3d(0, 0, 1), std::cos(a)},
      second{V3d(std::sin(between), 0, std::cos(between)), std::cos(b)};
  // The crossing (x, y, z) has z = cos a, and x by its product with the second axis.
  const double z = std::cos(a), x = (std::cos(b) - z * std::cos(between)) / std::sin(between);
  const double y = std::sqrt(1 - z * z - x * x);
  const Beam both = sharedBeam(first, second);
  EXPECT_NEAR(both.cosine, std::sqrt(1 - y * y), 1e-12);
  for (const double side : {-y, y}) EXPECT_NEAR(V3d(x, side, z).dot(both.axis), both.cosine, 1e-12);
}

TEST(Beam, OneWithinAnotherIsWhatTheyShare) {
  const Beam wide{V3d(0, 0, 1), .5}, narrow{V3d(.1, 0, 1).normalized(), .99}, all;
  EXPECT_EQ(sharedBeam(wide, narrow).cosine, .99);
  EXPECT_EQ(sharedBeam(narrow, wide).axis, narrow.axis);
  EXPECT_EQ(sharedBeam(all, wide).cosine, .5);
  EXPECT_EQ(sharedBeam(wide, all).axis, wide.axis);
  EXPECT_EQ(sharedBeam(wide, wide).cosine, .5);
}

TEST(Beam, BeamsSideBySideShareNothing) {
  const Beam first{V3d(0, 0, 1), .99}, second{V3d(1, 0, 1).normalized(), .98};
  EXPECT_GT(sharedBeam(first, second).cosine, 1.01);
  EXPECT_FALSE(sharedBeam(first, second).meets(V3d(0, 0, 0), Ball{V3d(.5, 0, 1), .1}));
}

TEST(Beam, ThroughAnOpeningHoldsAllThatLiesInItOrBeyond) {
  Random random(8);
  double closest = 1;
  for (int i = 0; i < 200; ++i) {
    const Ball from{near(V3d(0, 0, 0), 1, random), .3 * random.uniform()};
    const Ball opening{from.center + (.7 + random.uniform()) * direction(random), .3 * random.uniform()};
    const Beam beam = beamThrough(from, opening);
    for (int k = 0; k < 500; ++k) {
      const V3d start = near(from.center, from.radius, random);
      const V3d through = near(opening.center, opening.radius, random);
      const V3d end = through + (k % 2 ? 0 : 1e3) * (through - start);
      const double cosine = (end - from.center).normalized().dot(beam.axis);
      EXPECT_GE(cosine, beam.cosine - 1e-9);
      closest = std::min(closest, cosine - beam.cosine);
    }
  }
  EXPECT_LT(closest, .001);  // no wider than needed
  EXPECT_EQ(beamThrough(Ball{V3d(0, 0, 0), .6}, Ball{V3d(1, 0, 0), .5}).cosine, -1);
  EXPECT_EQ(beamThrough(Ball{}, Ball{}).cosine, -1);
}

TEST(Beam, MeetsBallsOfWhichAPointLiesInIt) {
  Random random(9);
  size_t met = 0, missed = 0;
  for (int i = 0; i < 1000; ++i) {
    const V3d apex = near(V3d(0, 0, 0), 2, random);
    const Beam beam{direction(random), .5 + .5 * random.uniform()};
    const Ball ball{near(V3d(0, 0, 0), 2, random), .5 * random.uniform()};
    bool any = false;
    for (int k = 0; k < 200; ++k) {
      const V3d point = near(ball.center, ball.radius, random);
      any = any || holds(beam, (point - apex).normalized(), 0);
    }
    EXPECT_TRUE(!any || beam.meets(apex, ball)) << i;
    met += beam.meets(apex, ball);
    missed += beam.meets(apex, ball) && !any;
  }
  EXPECT_GT(met, 100u);
  EXPECT_LT(missed, met / 5);  // by 200 points alone
}

}  // namespace
}  // namespace rsphere
