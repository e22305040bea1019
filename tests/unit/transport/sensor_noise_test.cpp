// Rays that a sensor (-I) adds where its gather is noisy.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "rays/ray_report.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// A dim sky of 1 W/sr/m2, and above a sensor at the origin a square of 100 W/sr/m2 whose form factor is 1.25%
// (sides of .4 at a height of 2).
const std::string kSmallBrightSquare =
    "void glow dim 0 0 4 1 1 1 0\ndim source sky 0 0 4 0 0 1 360\nvoid glow bright 0 0 4 100 100 100 0\n"
    "bright polygon square 0 0 12 -.2 -.2 2 -.2 .2 2 .2 .2 2 .2 -.2 2\n";

RayOptions interpolated(int divisions, int superSamples) {
  RayOptions o = unbiased(1);
  o.ambientAccuracy = .1;
  o.ambientDivisions = divisions;
  o.ambientSuperSamples = superSamples;
  return o;
}

// As on the command line, the ray comes down to the sensor from a little above.
Sample illuminances(const RayOptions& options, int count) {
  return Traced(kSmallBrightSquare, options, IrradianceAt::point)
      .mean(V3d(0, 0, 1.1e-4), V3d(0, 0, -1), count);
}

// The form factor of a square of side a, parallel to the sensor at height h, by the formula of a corner.
double formFactorOfSquare(double side, double height) {
  const double x = side / 2 / height, r = std::sqrt(1 + x * x);
  return 4 / (2 * kPi) * 2 * x / r * std::atan(x / r);
}

// If the noise of a half decided about its own rays, halves that miss the square would get too few, and the
// mean would be too dark. If both halves shared their strata, it would be 13% too bright.
TEST(SensorNoise, AddedRaysLeaveNoBias) {
  const double f = formFactorOfSquare(.4, 2);
  expectMean(illuminances(interpolated(48, 16), 10000), kPi * (1 + 99 * f), .97);
}

// 512 rays and at most 24 times 128 more: at most half of the variance.
TEST(SensorNoise, AddedRaysReduceTheNoise) {
  const Sample with = illuminances(interpolated(384, 128), 500),
               without = illuminances(interpolated(512, 0), 500);
  EXPECT_LT(with.standardError(), .7 * without.standardError());
}

// 384 rays each, and at most 24 times 8 or 192 more.
TEST(SensorNoise, FewDivisionsRemainADraft) {
  const Sample draft = illuminances(interpolated(8, 376), 500),
               fine = illuminances(interpolated(192, 192), 500);
  EXPECT_GT(draft.standardError(), 1.4 * fine.standardError());
}

// The error that is allowed grows with -aa: with -aa 15 it is 125%.
TEST(SensorNoise, NoRaysAreAddedWhereItIsAllowed) {
  RayOptions coarse = interpolated(48, 16);
  coarse.ambientAccuracy = 15;
  const double fine = illuminances(interpolated(48, 16), 2000).standardError();
  EXPECT_GT(illuminances(coarse, 2000).standardError(), 1.4 * fine);
}

// If rays are added, the coefficients of the first rays are smaller, which a tree of rays (-otW) has to show.
TEST(SensorNoise, ContributionsSumToTheValue) {
  RayOptions options = interpolated(48, 16);
  options.ambientBounces = 3;
  Traced room(kRoomWithAWindow, options, IrradianceAt::point);
  int shown = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const V3d origin(1.5, 3, 1), down(0, 0, -1);
    Color sum(0, 0, 0);
    const RayObserver observer = [&](const RayEnd& end, const RayResult& result) {
      if (end.context.depth != 1) return;
      sum += branchAnswer(room.prepared(), end, result).contribution.color * result.value.color;
      ++shown;
    };
    const Color value = room.color(origin, down, seed, 0, {.observer = &observer});
    EXPECT_EQ(value, room.color(origin, down, seed));
    EXPECT_NEAR(sum.x, value.x, 1e-9 * value.x);
  }
  EXPECT_GT(shown, 20 * (48 + 16) * 1.5);  // more than -ad and -as ask for
}

}  // namespace
}  // namespace rsphere
