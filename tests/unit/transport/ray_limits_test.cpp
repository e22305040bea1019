#include "transport/ray_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/unit/transport/small_scenes.h"

namespace rsphere::ray_limits_test {
namespace {

using namespace small_scenes;

TEST(Limits, DistanceEndsTheRay) {
  Traced scene(light(2) + "lamp sphere l\n0\n0\n4 0 0 5 1\n" + glow(1, 0) +
               "sky source all\n0\n0\n4 0 0 1 360\n");
  EXPECT_EQ(scene.value(kOrigin, kUp, 1, 4.5), 2);
  EXPECT_EQ(scene.value(kOrigin, kUp, 1, 3.5), 0);
  EXPECT_EQ(scene.value(kOrigin, kDown, 1, 3.5), 0) << "the sky is farther";
  EXPECT_EQ(scene.value(kOrigin, kDown), 1);
}

// Between two facing mirrors a ray is reflected 5 times before it sees the sky.
TEST(Limits, ReflectionsAndWeightEndPathsWhereTheyAreTold) {
  const std::string scene = "void mirror m\n0\n0\n3 .5 .5 .5\n" + floor("m", -1) + floor("m", 1, 10, false) +
                            glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  const auto seen = [&](int reflectionLimit, double weightLimit) {
    RayOptions o;
    o.reflectionLimit = reflectionLimit;
    o.weightLimit = weightLimit;
    return Traced(scene, o).mean(V3d(0, 0, 0), V3d(1, 0, 1), 4000);
  };
  const double all = std::pow(.5, 5);
  EXPECT_NEAR(seen(5, 1e-4).mean(), all, 1e-12);
  EXPECT_EQ(seen(4, 1e-4).mean(), 0);
  EXPECT_NEAR(seen(-5, 1e-4).mean(), all, 1e-12);
  EXPECT_EQ(seen(-4, 1e-4).mean(), 0);
  EXPECT_NEAR(seen(0, 1e-4).mean(), all, 1e-12) << "0: no limit but the weight's";
  EXPECT_NEAR(seen(10, .03).mean(), all, 1e-12);
  EXPECT_EQ(seen(10, .04).mean(), 0) << "cut off";
  expectMean(seen(-10, .2), all, 1.3);
}

// The error occurs where a path would be subject to roulette, as in rtrace.
TEST(Limits, RussianRouletteNeedsAWeight) {
  const std::string lamp = light(1) + "lamp sphere bulb\n0\n0\n4 0 0 5 .5\n";
  RayOptions options;
  options.weightLimit = 0;
  Traced diffuse(lamp + plastic("paint", .5) + floor("paint"), options);
  EXPECT_GT(diffuse.value(V3d(0, 0, 1), kDown), 0);
  Traced mirror(lamp + "void metal paint\n0\n0\n5 .9 .9 .9 1 0\n" + floor("paint"), options);
  EXPECT_THROW(mirror.value(V3d(0, 0, 1), kDown), rad::Error);
  options.reflectionLimit = 4;
  Traced limited(lamp + "void metal paint\n0\n0\n5 .9 .9 .9 1 0\n" + floor("paint"), options);
  EXPECT_GT(limited.value(V3d(0, 0, 1), kDown), 0);
}

// rtrace -h -ld -op (6.1a): the end of a ray that hits nothing within its maximal length.
TEST(Limits, LimitedRaysEndWhereTheyAreLimited) {
  Traced empty(light(1) + "lamp sphere bulb\n0\n0\n4 0 0 5 .5\n");
  EXPECT_EQ(empty.tracer().cast(kOrigin, kUp, 3).point, V3d(0, 0, 3));
  EXPECT_EQ(empty.tracer().cast(kOrigin, kDown, 0).point, kOrigin);
  EXPECT_EQ(empty.tracer().cast(kOrigin, kUp, 7).point, V3d(0, 0, 4.5));
}

// Russian roulette may increase the variance, but does not change the mean.
TEST(Limits, RouletteKeepsTheMean) {
  const std::string scene =
      plastic("wall", .7) + light(100) + "wall bubble s\n0\n0\n4 0 0 0 1\nlamp sphere l\n0\n0\n4 0 0 .3 .1\n";
  const auto seen = [&](double weightLimit, int count) {
    RayOptions o = unbiased(12);
    o.weightLimit = weightLimit;
    return Traced(scene, o).mean(V3d(.5, 0, 0), V3d(1, .2, .1), count);
  };
  const Sample full = seen(1e-6, 20000);
  for (const double lw : {1e-2, .2}) {
    const Sample cut = seen(lw, 40000);
    const double error = std::hypot(full.standardError(), cut.standardError());
    EXPECT_LT(std::abs(cut.mean() - full.mean()), kMostSigmas * error) << "-lw " << lw;
    EXPECT_GT(.05 * full.mean(), kMostSigmas * error) << "5% would have been noticed";
  }
  // If survivors did not get a higher weight, the mean would be lower, as it is with -lr above 0.
  RayOptions o = unbiased(12);
  o.weightLimit = .2;
  o.reflectionLimit = 1000;
  const Sample spoiled = Traced(scene, o).mean(V3d(.5, 0, 0), V3d(1, .2, .1), 10000);
  EXPECT_LT(spoiled.mean(),
            full.mean() - kMostSigmas * std::hypot(full.standardError(), spoiled.standardError()));
}

}  // namespace
}  // namespace rsphere::ray_limits_test
