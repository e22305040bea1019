#include "spots/bright_spots.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/transport/transport_fixture.h"
#include "transport/find_aims.h"

namespace rsphere {
namespace {

// A room of 4 x 4 x 3, white.
const std::string kRoom =
    "void plastic white\n0\n0\n5 .6 .6 .6 0 0\nvoid light shining\n0\n0\n3 100 100 100\n"
    "white polygon floor\n0\n0\n12 0 0 0 4 0 0 4 4 0 0 4 0\n"
    "white polygon ceiling\n0\n0\n12 0 0 3 0 4 3 4 4 3 4 0 3\n"
    "white polygon left\n0\n0\n12 0 0 0 0 4 0 0 4 3 0 0 3\n"
    "white polygon right\n0\n0\n12 4 0 0 4 0 3 4 4 3 4 4 0\n"
    "white polygon near\n0\n0\n12 0 0 0 0 0 3 4 0 3 4 0 0\n"
    "white polygon far\n0\n0\n12 0 4 0 4 4 0 4 4 3 0 4 3\n";

// A bulb in a pot that is open above, below the ceiling.
const std::string kPot =
    "shining sphere bulb\n0\n0\n4 1 1 2.5 .02\n"
    "white tube shade\n0\n0\n7 1 1 2.4 1 1 2.7 .3\nwhite cylinder outside\n0\n0\n7 1 1 2.4 1 1 2.7 .302\n"
    "white ring bottom\n0\n0\n8 1 1 2.4 0 0 1 0 .302\n";

BrightSpots spotsOf(const Traced& t) {
  return BrightSpots(t.scene(), t.prepared().tracer(), t.prepared().lights(), t.prepared().functions());
}

TEST(BrightSpots, AreWhereLightIsThick) {
  const Traced pot(kRoom + kPot);
  EXPECT_FALSE(spotsOf(pot).empty());
  BrightSpots::Aim aim;
  spotsOf(pot).aim({V3d(3, 3, 0), V3d(0, 0, 1)}, aim);
  EXPECT_GT(aim.mean, .3 * spotsOf(pot).usual());
  // No spot is in front of the back of the floor.
  spotsOf(pot).aim({V3d(3, 3, 0), V3d(0, 0, -1)}, aim);
  EXPECT_EQ(aim.mean, 0);
}

TEST(BrightSpots, AreNotWhereItIsEven) {
  const Traced even(kRoom + "shining polygon panel\n0\n0\n12 1 1 2.99 1 3 2.99 3 3 2.99 3 1 2.99\n");
  EXPECT_TRUE(spotsOf(even).empty());
  EXPECT_TRUE(spotsOf(Traced(kRoom)).empty());
  EXPECT_TRUE(spotsOf(Traced("")).empty());
}

// A white box under a narrow beam on a black stage, of which particles in all directions would hit one in
// 250. With patches or without, gathers of some hundred rays that hit the box by chance answered 0 with
// an error of 0.
TEST(BrightSpots, AreUnderNarrowBeams) {
  const std::string stage =
      "void plastic white\n0\n0\n5 .75 .75 .75 0 0\nvoid plastic black\n0\n0\n5 .02 .02 .02 0 0\n"
      "lamp ring lens\n0\n0\n8 6 5 6.5 0 0 -1 0 .1\n"
      "black polygon floor\n0\n0\n12 0 0 0 12 0 0 12 10 0 0 10 0\n"
      "black polygon back\n0\n0\n12 0 10 0 12 10 0 12 10 7 0 10 7\n"
      "white polygon box\n0\n0\n12 5.7 4.7 1 6.3 4.7 1 6.3 5.3 1 5.7 5.3 1\n";
  for (const std::string lamp :
       {"void spotlight lamp\n0\n0\n7 40000 40000 40000 10 0 0 -1\n",
        "void brightfunc beam\n2 if(Dz-.996,1,0) .\n0\n0\nbeam light lamp\n0\n0\n3 40000 40000 40000\n"}) {
    RayOptions byPaths;
    byPaths.ambientBounces = 2;
    byPaths.ambientDivisions = 256;
    byPaths.ambientAccuracy = 0;
    const Traced t(lamp + stage, byPaths);
    const FoundAims found = findAimsOfGathers(t.prepared());
    const BrightSpots* const spots = found.of<BrightSpots>();
    ASSERT_NE(spots, nullptr) << lamp;
    const V3d sensor(6, 1, 3), below(0, 0, -1);
    BrightSpots::Aim aim;
    spots->aim({sensor, below}, aim);
    ASSERT_GT(aim.mean, 0) << lamp;
    Random random(1);
    Sample onBox;
    for (int i = 0; i < 1000; ++i) {
      const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
      const V3d direction = spots->sample(aim, u1, u2, u3), at = sensor - 2 / direction.z * direction;
      onBox.add(std::abs(at.x - 6) < .3 && std::abs(at.y - 5) < .3);
    }
    EXPECT_GT(onBox.mean(), .5) << lamp;
  }
}

// The share of the directions aimed from the middle of the floor that meet the ceiling at x < 2.
double shareOfTheFirstHalf(const BrightSpots& spots) {
  const V3d point(2, 2, 0);
  BrightSpots::Aim aim;
  spots.aim({point, V3d(0, 0, 1)}, aim);
  if (!(aim.mean > 0)) return 0;
  Random random(1);
  Sample first;
  for (int i = 0; i < 4000; ++i) {
    const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
    first.add(spots.sample(aim, u1, u2, u3).x < 0);
  }
  return first.mean();
}

// Two equal tubes below a ceiling had all their spots beside one of them: the group of particles around the
// other was never divided, because its first division gained too little.
TEST(BrightSpots, AreBesideEachOfTwoTubes) {
  const std::string one = "shining cylinder one\n0\n0\n7 .4 2 2.93 1.6 2 2.93 .02\n",
                    other = "shining cylinder other\n0\n0\n7 2.4 2 2.93 3.6 2 2.93 .02\n";
  EXPECT_NEAR(shareOfTheFirstHalf(spotsOf(Traced(kRoom + one + other))), .5, .15);
  EXPECT_GT(shareOfTheFirstHalf(spotsOf(Traced(kRoom + one))), .9);
}

// Six tubes below a ceiling: the dark groups of particles had taken most of the number of spots, so that
// bands of light of 1.5 m were spots as wide as they are long.
TEST(BrightSpots, AreAsNarrowAsTheLightOfTubes) {
  std::string room =
      "void plastic white\n0\n0\n5 .6 .6 .6 0 0\nvoid light shining\n0\n0\n3 100 100 100\n"
      "white polygon floor\n0\n0\n12 0 0 0 8 0 0 8 6 0 0 6 0\n"
      "white polygon ceiling\n0\n0\n12 0 0 3 0 6 3 8 6 3 8 0 3\n"
      "white polygon left\n0\n0\n12 0 0 0 0 6 0 0 6 3 0 0 3\n"
      "white polygon right\n0\n0\n12 8 0 0 8 0 3 8 6 3 8 6 0\n"
      "white polygon near\n0\n0\n12 0 0 0 0 0 3 8 0 3 8 0 0\n"
      "white polygon far\n0\n0\n12 0 6 0 8 6 0 8 6 3 0 6 3\n";
  for (int i = 0; i < 6; ++i) {
    const double x = 1 + 2.3 * (i / 2), y = 1.5 + 3 * (i % 2);
    room += fmt::format("shining cylinder tube\n0\n0\n7 {} {} 2.95 {} {} 2.95 .008\n", x, y, x + 1.45, y);
  }
  const V3d point(4, 3, 0);
  const Traced traced(room);
  const BrightSpots spots = spotsOf(traced);
  BrightSpots::Aim aim;
  spots.aim({point, V3d(0, 0, 1)}, aim);
  ASSERT_GT(aim.mean, 0);
  Random random(1);
  Sample besideTube;
  for (int i = 0; i < 4000; ++i) {
    const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
    const V3d direction = spots.sample(aim, u1, u2, u3), at = point + 3 / direction.z * direction;
    besideTube.add(std::min(std::abs(at.y - 1.5), std::abs(at.y - 4.5)) < .1);
  }
  EXPECT_GT(besideTube.mean(), .45);  // .53; with dark groups .37
}

// The density of aimed directions is density(): the integral of a function over a cap, weighted with this
// density, agrees with the mean over sampled directions.
TEST(BrightSpots, AreAimedAtAsDensitySays) {
  const Traced pot(kRoom + kPot);
  const BrightSpots spots = spotsOf(pot);
  for (const V3d& point : {V3d(3, 3, 0), V3d(1, 1.5, 0), V3d(2, .3, 2.9)}) {
    const V3d middle = (V3d(1, 1, 2.7) - point).normalized();
    BrightSpots::Aim aim;
    spots.aim({point, middle}, aim);
    ASSERT_GT(aim.mean, 0);
    const double versine = .1;
    Random random(1);
    Sample sampled, weighted;
    const auto [x, y] = frame(middle);
    const auto some = [x = x, y = y](const V3d& d) { return 1 + 8 * d.dot(x) + 3 * d.dot(y); };
    for (int i = 0; i < 100000; ++i) {
      const V3d d = spots.sample(aim, random.uniform(), random.uniform(), random.uniform());
      EXPECT_NEAR(d.length(), 1, 1e-12);
      EXPECT_GT(spots.density(aim, d), 0);
      sampled.add(d.dot(middle) > 1 - versine ? some(d) : 0);
      const double z = 1 - versine * random.uniform(), angle = 2 * std::numbers::pi * random.uniform();
      const double r = std::sqrt(1 - z * z);
      const V3d even = r * std::cos(angle) * x + r * std::sin(angle) * y + z * middle;
      weighted.add(2 * std::numbers::pi * versine * spots.density(aim, even) * some(even));
    }
    EXPECT_GT(sampled.mean(), .1);
    const double error = std::hypot(sampled.standardError(), weighted.standardError());
    EXPECT_LT(std::abs(sampled.mean() - weighted.mean()), kMostSigmas * error);
    EXPECT_GT(std::abs(1.1 * sampled.mean() - weighted.mean()), kMostSigmas * error);
  }
}

// A number just below 1 is 1 in single precision. Near some of these points, the last spot contributes
// nothing because it contains the point.
TEST(BrightSpots, TheLargestNumberChoosesASpotThatContributes) {
  const Traced pot(kRoom + kPot);
  const BrightSpots spots = spotsOf(pot);
  const double largest = std::nextafter(1., 0.);
  int inLast = 0;
  for (int i = 0; i < 400; ++i) {
    const double angle = .1 * i, radius = .3 * (i % 20) / 20;
    const V3d point(1 + radius * std::cos(angle), 1 + radius * std::sin(angle), 2.4 + .3 * (i % 7) / 7);
    BrightSpots::Aim aim;
    spots.aim({point, V3d(0, 0, 1)}, aim);
    if (!(aim.mean > 0)) continue;
    inLast += aim.count > 1 && !(aim.sum[aim.count - 1] > aim.sum[aim.count - 2]);
    const V3d direction = spots.sample(aim, largest, .5, .5);
    EXPECT_NEAR(direction.length(), 1, 1e-12);
    EXPECT_GT(spots.density(aim, direction), 0);
  }
  EXPECT_GT(inLast, 0);
}

// Aimed paths give the same mean with less noise. The reference is the mean of 20 million paths that are not
// aimed, with a standard error of 1.9e-6 (mean() below with that count).
TEST(BrightSpots, LeaveTheMeanAsItIs) {
  Traced pot(kRoom + kPot, unbiased(2));
  const BrightSpots spots = spotsOf(pot);
  PathTracer aimed = pot.tracerWith(Aims(&spots));
  const V3d origin(3, 2.5, 1), down(.1, .2, -1);
  constexpr double kMean = 7.0979e-4;
  constexpr int kPaths = 80000;
  Sample sample;
  for (int i = 0; i < kPaths; ++i)
    sample.add(aimed.trace(origin, down.normalized(), 0, mixBits(i)).value.color.x);
  expectMean(sample, kMean, 1.08);
  EXPECT_LT(sample.standardError(), .5 * pot.mean(origin, down, kPaths).standardError());
}

Openings openingsOf(const std::string& text) {
  Traced t(text, unbiased(1));
  return findOpenings(t.prepared());
}

TEST(BrightSpots, AreWhereTheSunShinesThroughOpenings) {
  const Traced room(kSunlitRoom, unbiased(1));
  const Openings openings = openingsOf(kSunlitRoom);
  ASSERT_FALSE(openings.empty());
  const BrightSpots spots(room.scene(), room.prepared().tracer(), room.prepared().lights(),
                          room.prepared().functions(), &openings);
  for (const V3d& point : {V3d(2, 2, 3), V3d(3, 3.5, 3)}) {
    BrightSpots::Aim aim;
    spots.aim({point, V3d(0, 0, -1)}, aim);
    ASSERT_GT(aim.mean, .3 * spots.usual());
    Random random(1);
    Sample onSunlit;
    for (int i = 0; i < 2000; ++i) {
      const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
      const V3d d = spots.sample(aim, u1, u2, u3);
      EXPECT_GT(spots.density(aim, d), 0);
      const V3d at = point - d * (point.z / d.z);
      onSunlit.add(d.z < 0 && std::abs(at.x - 2) < .5 && std::abs(at.y - 1.5) < .5);
    }
    // Spots are round and overlap: they cover the square and a margin around it.
    EXPECT_GT(onSunlit.mean(), .5);
  }
  // Without openings, few of the particles that the sun sends to so wide a scene enter through the window.
  BrightSpots::Aim aim;
  spotsOf(room).aim({V3d(2, 2, 3), V3d(0, 0, -1)}, aim);
  EXPECT_EQ(aim.mean, 0);
}

// A wide room with a skylight at the top of a shaft, whose walls alone the low sun reaches. As they see
// little but each other, they once seemed to be a whole room that is evenly lit, and rays were aimed at
// nothing.
TEST(BrightSpots, AreInTheShaftOfASkylight) {
  const std::string text =
      "void plastic white 0 0 5 .6 .6 .6 0 0\nvoid light bright 0 0 3 5e6 5e6 5e6\n"
      "bright source sun 0 0 4 -.6 0 .5 .5\nvoid glow blue 0 0 4 3 3 3 0\nblue source sky 0 0 4 0 0 1 180\n"
      "void glass clear 0 0 3 .9 .9 .9\n"
      "white polygon floor 0 0 12 0 0 0 10 0 0 10 10 0 0 10 0\n"
      "white polygon ceiling 0 0 30 0 0 3 0 10 3 10 10 3 10 0 3 0 0 3 5 5 3 6 5 3 6 6 3 5 6 3 5 5 3\n";
  const auto wall = [](const char* name, double x1, double y1, double x2, double y2, double z1, double z2) {
    return fmt::format("white polygon {0} 0 0 12 {1} {2} {5} {3} {4} {5} {3} {4} {6} {1} {2} {6}\n", name, x1,
                       y1, x2, y2, z1, z2);
  };
  const std::string walls = wall("south", 0, 0, 10, 0, 0, 3) + wall("east", 10, 0, 10, 10, 0, 3) +
                            wall("north", 10, 10, 0, 10, 0, 3) + wall("west", 0, 10, 0, 0, 0, 3) +
                            wall("shaft_s", 5, 5, 6, 5, 3, 4.2) + wall("shaft_e", 6, 5, 6, 6, 3, 4.2) +
                            wall("shaft_n", 6, 6, 5, 6, 3, 4.2) + wall("shaft_w", 5, 6, 5, 5, 3, 4.2) +
                            "clear polygon pane 0 0 12 5 5 4.2 6 5 4.2 6 6 4.2 5 6 4.2\n";
  const Traced room(text + walls, unbiased(1));
  const Openings openings = openingsOf(text + walls);
  ASSERT_FALSE(openings.empty());
  const BrightSpots spots(room.scene(), room.prepared().tracer(), room.prepared().lights(),
                          room.prepared().functions(), &openings);
  BrightSpots::Aim aim;
  spots.aim({V3d(4.8, 5.5, .8), V3d(0, 0, 1)}, aim);
  EXPECT_GT(aim.mean, .5 * spots.usual());
}

TEST(BrightSpots, ThroughOpeningsLeaveTheMeanAsItIs) {
  Traced room(kSunlitRoom, unbiased(1));
  const Openings openings = openingsOf(kSunlitRoom);
  const BrightSpots spots(room.scene(), room.prepared().tracer(), room.prepared().lights(),
                          room.prepared().functions(), &openings);
  PathTracer aimed = room.tracerWith(Aims(&spots));
  // A ray to the north wall, below the sill, where no ground is visible through the window.
  const V3d origin(2, 2, .9), north = V3d(.1, 1, 0).normalized();
  Sample with, without;
  for (uint64_t i = 0; i < 30000; ++i) {
    with.add(aimed.trace(origin, north, 0, mixBits(i)).value.color.x);
    without.add(room.value(origin, north, mixBits(i + 1000000)));
  }
  const double error = std::hypot(with.standardError(), without.standardError());
  EXPECT_LT(std::abs(with.mean() - without.mean()), kMostSigmas * error);
  EXPECT_GT(std::abs(1.3 * with.mean() - without.mean()), kMostSigmas * error) << "the spoiled twin";
  EXPECT_LT(with.standardError(), .5 * without.standardError());
}

}  // namespace
}  // namespace rsphere
