#include "companions/compare/report.h"

#include <gtest/gtest.h>

namespace rsphere {
namespace {

Comparison noisy(double ours, double original) {
  Comparison comparison;
  comparison.channels[1].ourNoise = ours;
  comparison.channels[1].originalNoise = original;
  return comparison;
}

// Noise falls with the number of rays or with its square root; the time is proportional to the number.
TEST(Report, EqualErrorIsASettingOfTheOriginal) {
  EXPECT_EQ(
      equalErrorText(noisy(.01, .04), 128, 2, 3),
      "Equal error: with -Cn 512 to 2048 the original is about as noisy as rsphere (its noise falls with the "
      "number of rays, or its square root). All repeats then take it about 12 to 48 s of CPU time; rsphere "
      "took 2 "
      "s.\n");
  EXPECT_EQ(equalErrorText(noisy(.02, .01), 128, 2, 3),
            "Equal error: with -Cn 32 to 64 the original is about as noisy as rsphere (its noise falls with "
            "the number "
            "of rays, or its square root). All repeats then take it about 0.75 to 1.5 s of CPU time; rsphere "
            "took 2 "
            "s.\n");
}

TEST(Report, EqualErrorBeyondWhatTheSettingAllows) {
  EXPECT_EQ(equalErrorText(noisy(.00001, .1), 128, 2, 3),
            "Equal error: more than the 1000000 rays that -Cn allows; fewer directions of rsphere (-Sn, -Sx) "
            "do it.\n");
  EXPECT_EQ(
      equalErrorText(noisy(1, .01), 128, 2, 3),
      "Equal error: fewer than the 8 rays that -Cn needs; more directions of rsphere (-Sn, -Sx) do it.\n");
  EXPECT_EQ(equalErrorText(noisy(0, .01), 128, 2, 3), "Equal error: one of them has no noise to go by.\n");
}

}  // namespace
}  // namespace rsphere
