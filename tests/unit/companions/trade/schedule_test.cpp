#include "companions/trade/schedule.h"

#include <gtest/gtest.h>

namespace rsphere {
namespace {

ReferenceProgress progress(double rotations, double seconds, double error, size_t points = 32) {
  ReferenceProgress p;
  p.rotations = rotations;
  p.leastRotations = 8;
  p.seconds = seconds;
  p.error = error;
  p.target = .001;
  p.points = points;
  return p;
}

// Errors fall with the square root of the number of rotations.
TEST(Schedule, OfTheReference) {
  EXPECT_DOUBLE_EQ(secondsLeft(progress(2, 4, .01)), 396);  // 200 rotations of two seconds
  EXPECT_DOUBLE_EQ(secondsLeft(progress(2, 4, .001)), 12);  // eight rotations are the minimum
  EXPECT_DOUBLE_EQ(secondsLeft(progress(10, 20, .0005)), 0);
  // One rotation, or two of a single point, do not suffice to estimate the error.
  EXPECT_FALSE(canPredict(progress(1, 2, 0)));
  EXPECT_FALSE(canPredict(progress(2, 2, .01, 1)));
  EXPECT_TRUE(canPredict(progress(5, 2, .01, 1)));
  EXPECT_DOUBLE_EQ(secondsLeft(progress(1, 2, 0)), 14);
  EXPECT_DOUBLE_EQ(secondsLeft(progress(.25, 2, 0)), 62);
}

TEST(Schedule, ASlowReferenceNamesWhatMakesItQuicker) {
  EXPECT_EQ(slowReference(progress(2, 4, .003)), "");  // 36 s
  // A minute suffices for 30 rotations, whose error is 1% times the square root of 2/30.
  EXPECT_EQ(
      slowReference(progress(2, 4, .01)),
      "the reference takes about 6.7 min (error 1% after 2 rotations, 0.1% wanted): -Te 0.0026 ends it after "
      "60 s, -Tm 4 measures fewer points");
  EXPECT_EQ(slowReference(progress(1, 20, 0)),
            "the reference takes at least 2.7 min for its 8 rotations: -Tm 12 measures fewer points");
  EXPECT_EQ(
      slowReference(progress(2, 40, .01)),
      "the reference takes about 67 min (error 1% after 2 rotations, 0.1% wanted): -Te 0.005 ends it after "
      "2.7 min, -Tm 12 measures fewer points");
  ReferenceProgress slow = progress(.5, 3600, 0);
  slow.moreThreads = true;
  EXPECT_EQ(
      slowReference(slow),
      "the reference takes at least 16.0 h for its 8 rotations: -Tm 1 measures fewer points, -n 0 uses all "
      "cores");
}

TEST(Schedule, OfSettings) {
  AnswerOptions one, four;
  one.sphere.baseDirections = four.sphere.baseDirections = 100;
  one.ray.ambientDivisions = 1;
  four.ray.ambientDivisions = 16;
  one.ray.ambientBounces = four.ray.ambientBounces = 2;
  EXPECT_DOUBLE_EQ(costOf(one), 100);
  EXPECT_DOUBLE_EQ(costOf(four), 800);
  four.ray.ambientBounces = 0;
  EXPECT_DOUBLE_EQ(costOf(four), 100);
  const double costs[] = {1, 2, 3};
  EXPECT_DOUBLE_EQ(secondsLeft(costs, 1, 5), 25);
  EXPECT_DOUBLE_EQ(secondsLeft(costs, 3, 5), 0);
  EXPECT_DOUBLE_EQ(secondsLeft(costs, 0, 5), 0);
}

TEST(Schedule, DurationsAreShort) {
  EXPECT_EQ(durationText(0), "0 s");
  EXPECT_EQ(durationText(59.6), "60 s");
  EXPECT_EQ(durationText(150), "2.5 min");
  EXPECT_EQ(durationText(720), "12 min");
  EXPECT_EQ(durationText(9000), "2.5 h");
}

}  // namespace
}  // namespace rsphere
