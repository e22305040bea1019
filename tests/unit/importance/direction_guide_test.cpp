// Directions that follow where light comes from.
#include "importance/direction_guide.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "sphere/directions.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

using std::numbers::pi;

// A lamp that shines at the corner of a large room.
const std::string kRoom = "void plastic white 0 0 5 .5 .5 .5 0 0\nvoid light shining 0 0 3 1 1 1\n" +
                          roomOf("white", V3d(9, 9, 3)) +
                          "shining polygon lamp 0 0 12 .4 .4 1 .4 .6 1 .6 .6 1 .6 .4 1\n";

TEST(DirectionGuide, DensityIntegratesToOneAndFollowsTheLight) {
  const Traced room(kRoom, unbiased(2));
  const LightPatches patches(room.prepared());
  const V3d point(6, 6, 1.5);
  const DirectionGuide guide(patches, room.prepared().tracer(), point);
  double sum = 0;
  const std::vector<V3d> all = baseDirections(100000);
  for (const V3d& d : all) sum += guide.density(d) * 4 * pi / static_cast<double>(all.size());
  EXPECT_NEAR(sum, 1, .01);
  EXPECT_GT(guide.density((V3d(.5, .5, 0) - point).normalized()), 10 / (4 * pi)) << "below the lamp";
  EXPECT_LT(guide.density(V3d(1, 1, 0).normalized()), .5 / (4 * pi)) << "the far corner";
}

// In each of some parts of the sphere there are as many directions as the density says.
TEST(DirectionGuide, DirectionsFollowTheDensity) {
  const Traced room(kRoom, unbiased(2));
  const LightPatches patches(room.prepared());
  const DirectionGuide guide(patches, room.prepared().tracer(), V3d(6, 6, 1.5));
  const auto partOf = [](const V3d& d) {
    return static_cast<size_t>((d.x > 0) + 2 * (d.y > .3) + 4 * (d.z > .1) + 8 * (d.z < -.3));
  };
  std::array<double, 16> expected{}, drawn{};
  const std::vector<V3d> all = baseDirections(200000);
  for (const V3d& d : all) expected[partOf(d)] += guide.density(d) * 4 * pi / static_cast<double>(all.size());
  constexpr size_t kCount = 500;
  Random random(1);
  double sum = 0, last = 0;
  for (int k = 0; k < 200; ++k) {
    const std::vector<V3d> directions = guide.directions(kCount, random);
    EXPECT_NEAR(static_cast<double>(directions.size()), kCount, 1);
    for (size_t i = 0; i < directions.size(); ++i) {
      EXPECT_NEAR(directions[i].length(), 1, 1e-12);
      EXPECT_GT(guide.density(directions[i]), 0);
      drawn[partOf(directions[i])] += 1. / (200 * kCount);
      if (i > 0) sum += (directions[i] - directions[i - 1]).length();
      if (i > 0) ++last;
    }
  }
  for (size_t i = 0; i < drawn.size(); ++i) EXPECT_NEAR(drawn[i], expected[i], .004) << i;
  EXPECT_LT(sum / last, .4) << "successive directions are near to each other";
}

// In a closed room of reflectance r that nothing darkens, patches send r + r^2 + ... = r / (1 - r) of the
// lamp's power.
TEST(LightPatches, SendWhatSurfacesReflect) {
  const Traced room(kRoom, unbiased(20));
  const LightPatches patches(room.prepared());
  double power = 0;
  for (const LightPatches::Patch& patch : patches.all()) power += patch.power;
  EXPECT_NEAR(power, .04 * pi * .5 / (1 - .5), .05 * .04 * pi);
  // The room's surfaces and the lamp.
  EXPECT_NEAR(patches.area() * static_cast<double>(patches.all().size()), 2 * 81 + 4 * 27 + .04, 1e-6);
}

TEST(DirectionGuide, KnowsNoLightInTheDark) {
  const Traced dark("void plastic white 0 0 5 .5 .5 .5 0 0\n" + roomOf("white", V3d(4, 4, 3)), unbiased(2));
  const LightPatches patches(dark.prepared());
  EXPECT_TRUE(patches.all().empty());
  const DirectionGuide guide(patches, dark.prepared().tracer(), V3d(1, 1, 1));
  Random random(1);
  EXPECT_TRUE(guide.directions(10, random).empty());
  EXPECT_EQ(guide.density(V3d(0, 0, 1)), 0);
}

}  // namespace
}  // namespace rsphere
