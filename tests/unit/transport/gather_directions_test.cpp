#include "transport/gather_directions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/transport/highlight_scene.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// The parts of the directions sum to 1 on average, however few they are.
TEST(GatherDirections, FewLeaveNoneOut) {
  const Traced room(kSunlitRoom, unbiased(2));
  const Aims aims = room.transport().aims();
  ASSERT_TRUE(aims.openings && aims.spots);
  const V3d point(2, 2, 3), normal(0, 0, -1);
  Openings::Aim openings;
  aims.openings->aim(point, normal, openings);
  BrightSpots::Aim spots;
  aims.spots->aim(point, normal, spots);
  ASSERT_GT(openings.mean, 0);
  ASSERT_GT(spots.mean, 0);
  const GatherDirections directions(aims, point, normal, normal, 64);
  for (const int count : {1, 2, 3, 8, 64}) {
    Random random(1);
    Sample sum;
    for (int i = 0; i < 60000 / count; ++i) {
      double parts = 0;
      directions.draw(count, random, [&](const V3d&, double part) { parts += part; });
      sum.add(parts);
    }
    expectMean(sum, 1, 1.05);
  }
}

// Directions that are not aimed all have the same part.
bool areAimed(const GatherDirections& directions) {
  constexpr int kCount = 256;
  Random random(1);
  bool aimed = false;
  directions.draw(kCount, random,
                  [&](const V3d&, double part) { aimed |= std::abs(part * kCount - 1) > 1e-9; });
  return aimed;
}

TEST(GatherDirections, AreAimedWhereThatPays) {
  const Traced room(kSunlitRoom, unbiased(2));
  const Aims openings{room.transport().aims().openings, nullptr};
  const V3d down(0, 0, -1), south(0, -1, 0);
  EXPECT_TRUE(areAimed({openings, V3d(2, 2, 3), down, down, 64}));
  EXPECT_FALSE(areAimed({Aims{}, V3d(2, 2, 3), down, down, 64})) << "nothing to aim at";
  EXPECT_FALSE(areAimed({openings, V3d(2, 2, 3), V3d(0, 0, 1), V3d(0, 0, 1), 64})) << "outdoors";
  EXPECT_TRUE(areAimed({openings, V3d(2, 2, 1.5), south, south, 64}));
  EXPECT_FALSE(areAimed({openings, V3d(2, .3, 1.5), south, south, 64}))
      << "the window fills half of the view";
}

// A room whose openings seem dark inside: no mean radiance is known, and no highlight may be in view.
TEST(GatherDirections, AreNotAimedWhereNothingIsSeen) {
  const Traced room(highlight_scene::kMaterials + "chrome sphere ball 0 0 4 2 2 1 .1\n" +
                        highlight_scene::kBulb + roomOf("matt", V3d(4, 4, 3)),
                    unbiased(1));
  const Openings dark({}, 0, 1);
  const Aims aims{&dark, nullptr, room.transport().aims().highlights};
  ASSERT_TRUE(aims.highlights);
  const V3d floor(1.5, 2, 0), up(0, 0, 1);
  EXPECT_TRUE(areAimed({aims, floor, up, up, 64}));
  EXPECT_FALSE(areAimed({aims, floor, -up, -up, 64}));
  const GatherDirections directions(aims, floor, -up, -up, 64);
  Random random(1);
  double parts = 0;
  directions.draw(64, random, [&](const V3d&, double part) { parts += part; });
  EXPECT_NEAR(parts, 1, 1e-12);
}

// Three bounces, each aimed at the window and at the sunlit floor. The ray ends on the north wall, where no
// ground is visible through the window.
TEST(GatherDirections, LeaveTheMeanOfPathsAsItIs) {
  Traced room(kSunlitRoom, unbiased(3));
  PathTracer aimed = room.tracerWith(room.transport().aims());
  const V3d origin(2, 2, .9), north = V3d(.1, 1, 0).normalized();
  Sample with, without;
  for (uint64_t i = 0; i < 40000; ++i) with.add(aimed.trace(origin, north, 0, mixBits(i)).value.color.x);
  for (uint64_t i = 0; i < 160000; ++i) without.add(room.value(origin, north, mixBits(i + 1000000)));
  const double error = std::hypot(with.standardError(), without.standardError());
  EXPECT_LT(std::abs(with.mean() - without.mean()), kMostSigmas * error);
  EXPECT_GT(std::abs(1.1 * with.mean() - without.mean()), kMostSigmas * error) << "the spoiled twin";
  EXPECT_LT(with.standardError(), without.standardError()) << "with a quarter of the paths";
}

}  // namespace
}  // namespace rsphere
