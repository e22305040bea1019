#include "transport/gather_directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/spots/highlight_scene.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// The parts of the directions sum to 1 on average, however few they are.
TEST(GatherDirections, FewLeaveNoneOut) {
  const Traced room(kSunlitRoom, unbiased(2));
  const Aims aims = room.transport().aims();
  ASSERT_TRUE(aims.of<Openings>() && aims.of<BrightSpots>());
  const V3d point(2, 2, 3), normal(0, 0, -1);
  Openings::Aim openings;
  aims.of<Openings>()->aim({point, normal}, openings);
  BrightSpots::Aim spots;
  aims.of<BrightSpots>()->aim({point, normal}, spots);
  ASSERT_GT(openings.mean, 0);
  ASSERT_GT(spots.mean, 0);
  const GatherDirections directions(aims, point, normal, normal, 64);
  for (const int count : {1, 2, 3, 8, 64}) {
    Random random(1);
    Sample sum;
    for (int i = 0; i < 60000 / count; ++i) {
      double parts = 0;
      directions.draw({count, random}, [&](const V3d&, double part) { parts += part; });
      sum.add(parts);
    }
    expectMean(sum, 1, 1.05);
  }
}

// Where nearly all light comes from a bright spot, half of the directions go elsewhere. The light that they
// find would otherwise count three times, and that noise grows from bounce to bounce between patches.
TEST(GatherDirections, HalfAreNotAimedAtSpots) {
  const Traced room(kSunlitRoom, unbiased(2));
  const Aims spots(room.transport().aims().of<BrightSpots>());
  const V3d point(2, 2, 3), normal(0, 0, -1);
  constexpr int kCount = 256;
  Random random(1);
  double largest = 0;
  GatherDirections(spots, point, normal, normal, kCount).draw({kCount, random}, [&](const V3d&, double part) {
    largest = std::max(largest, part * kCount);
  });
  EXPECT_GT(largest, 1.5) << "about half are aimed";
  EXPECT_LE(largest, 2 + 1e-9);
}

// Sets that share a lattice are nearly as even together as one set of as many directions. Without a common
// lattice (the spoiled twin), they are not.
TEST(GatherDirections, InterleavedSetsFormOneLattice) {
  const Traced room(kSunlitRoom, unbiased(2));
  const Aims openings(room.transport().aims().of<Openings>());
  const V3d point(2, 2, 3), normal(0, 0, -1);
  constexpr int kSets = kInterleavedGathers;
  double one = 0, together = 0, apart = 0;  // variances
  for (const int count : {24, 32, 48, 64, 96, 128}) {
    const GatherDirections directions(openings, point, normal, normal, count);
    const auto sumOf = [&](const DirectionSet& set) {
      double sum = 0;
      directions.draw(set, [&](const V3d& d, double part) { sum += part * (d.y > .6 ? 2 : 1 + d.x * d.y); });
      return sum;
    };
    Random random(1);
    Sample ofOne, ofTogether, ofApart;
    for (uint64_t seed = 0; seed < 1000; ++seed) {
      double sum = 0, independent = 0;
      for (int k = 0; k < kSets; ++k) {
        Random common(seed);
        const double part = sumOf(DirectionSet::interleaved(count, k, common));
        if (k == 1) ofOne.add(part);
        sum += part / kSets;
        independent += sumOf({count, random}) / kSets;
      }
      ofTogether.add(sum);
      ofApart.add(independent);
    }
    expectMean(ofOne, ofApart.mean());
    expectMean(ofTogether, ofApart.mean());
    one += std::pow(ofOne.standardError(), 2);
    together += std::pow(ofTogether.standardError(), 2);
    apart += std::pow(ofApart.standardError(), 2);
  }
  EXPECT_LT(together / one, .7 / kSets);
  EXPECT_GT(apart / one, .7 / kSets) << "the spoiled twin";
}

// Directions that are not aimed have all of the weight of a hemisphere without bright places, in each set.
TEST(GatherDirections, FewLeaveAWholeNumberUnaimed) {
  const Traced room(kSunlitRoom, unbiased(2));
  const V3d point(2, 2, 3), normal(0, 0, -1);
  for (const int count : {2, 4, 8, 23}) {
    const GatherDirections directions(room.transport().aims(), point, normal, normal, count);
    Random random(1);
    for (int set = 0; set < 200; ++set) {
      int unaimed = 0;
      double largest = 0;
      std::vector<double> parts;
      directions.draw({count, random}, [&](const V3d&, double part) { parts.push_back(part); });
      for (const double part : parts) largest = std::max(largest, part);
      for (const double part : parts) unaimed += part > largest * (1 - 1e-9);
      EXPECT_LE(unaimed * largest, 1 + 1e-9) << count << " directions";
    }
  }
}

// Directions that are not aimed all have the same part.
bool areAimed(const GatherDirections& directions) {
  constexpr int kCount = 256;
  Random random(1);
  bool aimed = false;
  directions.draw({kCount, random},
                  [&](const V3d&, double part) { aimed |= std::abs(part * kCount - 1) > 1e-9; });
  return aimed;
}

TEST(GatherDirections, AreAimedWhereThatPays) {
  const Traced room(kSunlitRoom, unbiased(2));
  const Aims openings(room.transport().aims().of<Openings>());
  const V3d down(0, 0, -1), south(0, -1, 0);
  EXPECT_TRUE(areAimed({openings, V3d(2, 2, 3), down, down, 64}));
  EXPECT_FALSE(areAimed({Aims{}, V3d(2, 2, 3), down, down, 64})) << "nothing to aim at";
  EXPECT_FALSE(areAimed({openings, V3d(2, 2, 3), V3d(0, 0, 1), V3d(0, 0, 1), 64})) << "outdoors";
  EXPECT_TRUE(areAimed({openings, V3d(2, 2, 1.5), south, south, 64}));
  EXPECT_FALSE(areAimed({openings, V3d(2, .3, 1.5), south, south, 64}))
      << "the window fills half of the view";
}

// A window is seen in a mirror on the west wall, and light comes by the mirror to the east wall.
TEST(GatherDirections, AreAimedAtImagesOfOpenings) {
  const std::string mirror =
      "void metal chrome 0 0 5 .9 .9 .9 1 0\n"
      "chrome polygon m 0 0 12 .02 .5 .1 .02 4.5 .1 .02 4.5 2.5 .02 .5 2.5\n";
  const Traced room(kRoomWithAWindow + mirror, unbiased(1));
  const OpeningImages* const images = room.transport().aims().of<OpeningImages>();
  ASSERT_TRUE(images);
  const Aims aims(images);
  const V3d east(3, 2.5, 1.2), west(-1, 0, 0), floor(1.5, .2, 0), up(0, 0, 1);
  EXPECT_FALSE(areAimed({aims, floor, up, up, 64})) << "the image lies beside the mirror";
  ASSERT_TRUE(areAimed({aims, east, west, west, 64}));
  const GatherDirections aimed(aims, east, west, west, 64), unaimed(Aims{}, east, west, west, 64);
  PathTracer tracer = room.tracerWith(Aims{});
  const auto bright = [&](const GatherDirections& directions, int n, Sample* parts) {
    Random random(1);
    Sample light;
    for (int i = 0; i < n; ++i) {
      double found = 0, all = 0;
      directions.draw({8, random}, [&](const V3d& direction, double part) {
        const double seen = tracer.trace(east, direction, 0, 1).value.color.y;
        found += part * (seen > .85 && seen < .95);  // the sky has 1, and .9 in the mirror
        all += part;
      });
      light.add(found);
      if (parts) parts->add(all);
    }
    return light;
  };
  Sample parts;
  const Sample some = bright(aimed, 4000, &parts), others = bright(unaimed, 4000, nullptr);
  expectMean(parts, 1, 1.05);
  EXPECT_NEAR(some.mean(), others.mean(), 4 * others.standardError());
  EXPECT_GT(std::abs(1.5 * some.mean() - others.mean()), 4 * others.standardError())
      << "would not see half as much again";
  EXPECT_LT(some.standardError(), .3 * others.standardError());
}

// A room whose openings seem dark inside: no mean radiance is known, and no highlight may be in view.
TEST(GatherDirections, AreNotAimedWhereNothingIsSeen) {
  const Traced room(highlight_scene::kMaterials + "chrome sphere ball 0 0 4 2 2 1 .1\n" +
                        highlight_scene::kBulb + roomOf("matt", V3d(4, 4, 3)),
                    unbiased(1));
  const Openings dark({}, 0, 1);
  const Aims aims(&dark, room.transport().aims().of<Highlights>());
  ASSERT_TRUE(aims.of<Highlights>());
  const V3d floor(1.5, 2, 0), up(0, 0, 1);
  EXPECT_TRUE(areAimed({aims, floor, up, up, 64}));
  EXPECT_FALSE(areAimed({aims, floor, -up, -up, 64}));
  const GatherDirections directions(aims, floor, -up, -up, 64);
  Random random(1);
  double parts = 0;
  directions.draw({64, random}, [&](const V3d&, double part) { parts += part; });
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
