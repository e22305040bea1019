#include "points/clamp.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/constants.h"
#include "estimate/estimator.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

// 99 directions that contribute 1 each, and one that contributes 901: 1000 together.
std::vector<DirectionSample> withOutlier() {
  std::vector<DirectionSample> samples(100, {V3d(0, 0, 1), 2, Radiance(.5)});
  samples[7].value = Radiance(450.5);
  return samples;
}

Irradiance totalOf(const std::vector<DirectionSample>& samples) {
  Irradiance total;
  for (const DirectionSample& s : samples) total += irradianceFrom(s.value, s.solidAngle);
  return total;
}

TEST(Clamp, LimitsTheOutlierAlone) {
  std::vector<DirectionSample> samples = withOutlier();
  const Irradiance before = totalOf(samples);
  const Irradiance taken = clampContributions(samples, before, .02, nullptr);
  // A fiftieth of 1000 would leave 20 of the 901; a fiftieth of what is left then, 119, is 2.38.
  EXPECT_NEAR(samples[7].value.color.y * samples[7].solidAngle, 2.38, 1e-9);
  EXPECT_NEAR(taken.color.y, 901 - 2.38, 1e-9);
  EXPECT_NEAR(totalOf(samples).color.y + taken.color.y, before.color.y, 1e-9);
  for (size_t i = 0; i < samples.size(); ++i)
    EXPECT_EQ(samples[i].value.color.y, i == 7 ? samples[7].value.color.y : .5) << i;
}

TEST(Clamp, KeepsTheColor) {
  std::vector<DirectionSample> samples = withOutlier();
  samples[7].value.color = Color(900, 450, 90);
  clampContributions(samples, totalOf(samples), .02, nullptr);
  const Color left = samples[7].value.color;
  EXPECT_NEAR(left.x / left.y, 2, 1e-12);
  EXPECT_NEAR(left.z / left.y, .2, 1e-12);
}

TEST(Clamp, LeavesWhatWasGuessed) {
  std::vector<DirectionSample> samples = withOutlier();
  samples[7].glanced = Radiance(450);
  EXPECT_EQ(clampContributions(samples, totalOf(samples), .02, nullptr).color.y, 0);
  EXPECT_EQ(samples[7].value.color.y, 450.5);
  // Without the guess it would be clamped: LimitsTheOutlierAlone.
}

TEST(Clamp, DarknessAndNegativeTotalsAreLeftAlone) {
  std::vector<DirectionSample> samples(3, {V3d(0, 0, 1), 1, Radiance(0)});
  EXPECT_EQ(clampContributions(samples, Irradiance(), .01, nullptr).color.y, 0);
  samples[1].value = Radiance(1);
  EXPECT_EQ(clampContributions(samples, Irradiance(-2), .01, nullptr).color.y, 0);
  EXPECT_EQ(samples[1].value.color.y, 1);
}

// A lamp beside a mirroring ball of rough metal, in a corridor: few directions find highlights of highlights.
struct Corridor {
  const Scene scene = sceneOf(R"(
void plastic wall 0 0 5 .5 .5 .5 0 0
wall polygon floor 0 0 12 0 0 0 2 0 0 2 6 0 0 6 0
wall polygon ceiling 0 0 12 0 0 2.5 0 6 2.5 2 6 2.5 2 0 2.5
wall polygon west 0 0 12 0 0 0 0 6 0 0 6 2.5 0 0 2.5
void metal brushed 0 0 5 .9 .9 .9 .9 .15
brushed sphere ball 0 0 4 1.2 5.2 .4 .3
void light lamp_mat 0 0 3 500 500 500
lamp_mat sphere lamp 0 0 4 1.2 5.2 .9 .02
wall polygon screen 0 0 12 .6 4.6 0 1.8 4.6 0 1.8 4.6 2 .6 4.6 2
)");
  Transport transport = [this] {
    RayOptions o;
    o.ambientBounces = 2;
    o.ambientAccuracy = 0;
    o.ambientDivisions = 1;
    o.directJitter = 1;
    o.directThreshold = 0;
    return Transport(scene, o, IrradianceAt::none);
  }();

  PointAnswer answer(uint64_t rotation, double clamp) const {
    SphereOptions o;
    o.baseDirections = 64;
    o.rotation = rotation;
    o.clamp = clamp;
    const SphereEstimator estimator(transport, o, true);
    SphereEstimator::Workspace workspace(estimator);
    return estimator.estimate(V3d(.9, .6, 1.2), workspace);
  }
};

TEST(Clamp, AnswersSayHowMuchTheyLost) {
  const Corridor corridor;
  double taken = 0;
  for (uint64_t rotation = 1; rotation <= 5; ++rotation) {
    const PointAnswer without = corridor.answer(rotation, 0), with = corridor.answer(rotation, .05);
    EXPECT_EQ(without.clamped, 0);
    EXPECT_NEAR(brightness(with.mean) + with.clamped, brightness(without.mean),
                1e-9 * brightness(without.mean));
    if (with.clamped > 0)
      EXPECT_LT(with.brightnessError, without.brightnessError);
    else
      EXPECT_EQ(with.brightnessError, without.brightnessError);
    taken += with.clamped;
  }
  EXPECT_GT(taken, 0) << "nothing was clamped: the test sees nothing";
}

}  // namespace
}  // namespace rsphere
