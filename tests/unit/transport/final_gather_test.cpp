#include "transport/final_gather.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/transport/transport_fixture.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

RayOptions optionsOf(double accuracy, int divisions, int superSamples) {
  RayOptions o;
  o.ambientAccuracy = accuracy;
  o.ambientDivisions = divisions;
  o.ambientSuperSamples = superSamples;
  return o;
}

TEST(RaysOfRecord, AreFewerWhereInterpolationMayErrMore) {
  using Of = tuning::Interpolation;
  struct Case {
    LitBy by;
    double rays;
    int part;
  };
  for (const auto& [by, rays, part] : {Case{LitBy::lamps, Of::kRaysByLamps, Of::kPartByLamps},
                                       Case{LitBy::openings, Of::kRaysByOpenings, Of::kPartByOpenings},
                                       Case{LitBy::sun, Of::kRaysBySun, Of::kPartBySun}}) {
    const double enough = rays / (.1 * .1);
    const int all = static_cast<int>(1.5 * enough);
    EXPECT_EQ(raysOfRecord(optionsOf(.1, all - 100, 100), LitBy::other), all);
    EXPECT_NEAR(raysOfRecord(optionsOf(.1, all - 100, 100), by), enough, 1);
    EXPECT_EQ(raysOfRecord(optionsOf(.05, all - 100, 100), by), all);
    EXPECT_EQ(raysOfRecord(optionsOf(9, all - 100, 100), by), (all + part - 1) / part);
    EXPECT_EQ(raysOfRecord(optionsOf(1, 1, 0), by), 1);
  }
}

TEST(IsLitByLamps, UnlessOnlyRaysFindSomeLight) {
  const std::string lamp = "void light bulb 0 0 3 1 1 1\nbulb sphere lamp 0 0 4 0 0 1 .1\n";
  EXPECT_TRUE(isLitByLamps(Traced(lamp).prepared()));
  EXPECT_FALSE(
      isLitByLamps(Traced(lamp + "void glow dim 0 0 4 1 1 1 0\ndim sphere ball 0 0 4 0 0 3 1\n").prepared()));
  EXPECT_FALSE(
      isLitByLamps(Traced(lamp + "void light sun 0 0 3 9 9 9\nsun source s 0 0 4 0 0 1 .5\n").prepared()));
}

TEST(LitBy, SunWhereItShinesThroughOpenings) {
  RayOptions o;
  o.ambientBounces = 2;
  const auto by = [&](const std::string& text) {
    return litBy(Traced(text, o).transport().caches().aims, false);
  };
  const std::string sun = "sunlight source sun 0 0 4 0 -1 1 .53\n";
  std::string overcast = kSunlitRoom;
  ASSERT_NE(overcast.find(sun), std::string::npos);
  overcast.erase(overcast.find(sun), sun.size());
  EXPECT_EQ(by(kSunlitRoom), LitBy::sun);
  EXPECT_EQ(by(overcast), LitBy::openings);
  EXPECT_EQ(by("void plastic wall 0 0 5 .5 .5 .5 0 0\n" + roomOf("wall", V3d(4, 4, 3))), LitBy::other);
}

}  // namespace
}  // namespace rsphere
