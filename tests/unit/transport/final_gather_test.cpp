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
  for (const LitBy by : {LitBy::lamps, LitBy::openings}) {
    const bool lamps = by == LitBy::lamps;
    using tuning::Interpolation;
    const double enough = (lamps ? Interpolation::kRaysByLamps : Interpolation::kRaysByOpenings) / (.1 * .1);
    const int part = lamps ? Interpolation::kPartByLamps : Interpolation::kPartByOpenings;
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

}  // namespace
}  // namespace rsphere
