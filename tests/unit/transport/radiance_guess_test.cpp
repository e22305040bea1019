#include "transport/radiance_guess.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"
#include "transport/bright_spots.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

constexpr const char* kMaterials =
    "void plastic gray 0 0 5 .6 .5 .4 0 0\nvoid metal steel 0 0 5 .6 .6 .6 .5 .1\nvoid mirror silver 0 0 3 "
    ".9 .9 .9\nvoid light lamp 0 0 3 20 20 20\n";
constexpr const char* kFloor = "gray polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n";

RayOptions finely(int bounces) {
  RayOptions o = unbiased(bounces);
  o.sourceSubstructuring = .05;
  return o;
}

RadianceGuess guessOf(const Traced& t) {
  ById<SurfaceId, bool> lights(t.scene().surfaces.size(), false);
  for (const LightSource& l : t.prepared().lights().all()) lights[l.surface] = true;
  return RadianceGuess(t.prepared(), lights);
}

// A guess fitted to the view from the point, in the same way as for spherical means.
LocalGuess fitted(const RadianceGuess& guess, Traced& t, const V3d& point, int rays = 0) {
  Random random(5);
  std::vector<V3d> glances(tuning::RadianceGuess::kFitGlances);
  for (V3d& d : glances) d = randomDirection(random);
  std::vector<RadianceGuess::Traced> traced;
  for (int i = 0; i < rays; ++i) {
    const V3d d = randomDirection(random);
    const TracedRay ray = t.tracer().trace(point, d, 0, random.bits());
    const Hit& hit = ray.firstHit;
    if (ray.shown.source == kNone)
      traced.push_back({guess.placeOf(point, d, hit), hit.surface, Radiance(ray.value.color)});
  }
  return guess.fit(point, glances, traced, 1);
}

// Without occlusion, the guess equals the radiance, for every kind of source.
TEST(RadianceGuess, IsTheRadianceWhereNothingIsHidden) {
  struct Case {
    const char* lamp;
    double tolerance;
  };
  for (const Case& c :
       {Case{"lamp polygon l 0 0 12 1 1 2 1 2 2 3 2 2 3 1 2\n", .16},
        Case{"lamp polygon l 0 0 9 1 1 2 1 2 2 3 2 2\n", .04}, Case{"lamp sphere l 0 0 4 1 1 2 .2\n", .04},
        Case{"lamp ring l 0 0 8 1 1 2 0 0 -1 0 .3\n", .05}, Case{"lamp source l 0 0 4 .5 .2 1 2\n", .01}}) {
    Traced room(std::string(kMaterials) + kFloor + c.lamp, finely(0));
    const RadianceGuess guess = guessOf(room);
    const V3d point(.5, .2, 1);
    const auto local = fitted(guess, room, point);
    for (double x = -3; x < 6; x += .7)
      for (double y = -3; y < 6; y += .7) {
        const V3d direction = (V3d(x, y, 0) - point).normalized();
        double traced = 0;
        for (uint64_t seed = 0; seed < 32; ++seed) traced += room.color(point, direction, seed).y / 32;
        EXPECT_NEAR(local.along(point, direction).color.y / traced, 1, c.tolerance)
            << c.lamp << x << ' ' << y;
      }
  }
}

TEST(RadianceGuess, KnowsNothingOfMirrorsLightsAndNothing) {
  Traced room(
      std::string(kMaterials) +
      "silver sphere m 0 0 4 2 0 0 .5\nlamp sphere l 0 0 4 0 0 3 .5\nsteel sphere s 0 0 4 0 2 0 .5\n");
  const RadianceGuess guess = guessOf(room);
  const V3d point(0, 0, 0);
  const auto local = fitted(guess, room, point);
  EXPECT_EQ(local.along(point, V3d(1, 0, 0)).color, Color(0, 0, 0));
  EXPECT_EQ(local.along(point, V3d(0, 0, 1)).color, Color(0, 0, 0));
  EXPECT_EQ(local.along(point, V3d(0, 0, -1)).color, Color(0, 0, 0));
  EXPECT_GT(local.along(point, V3d(0, 1, 0)).color.y, 0) << "the diffuse half of steel";
}

// The guess includes no light of a source that reaches no place.
TEST(RadianceGuess, LeavesOutSourcesThatAreShutOut) {
  const std::string lid = "gray polygon lid 0 0 12 -99 -99 3 99 -99 3 99 99 3 -99 99 3\n";
  const std::string sun = "lamp source l 0 0 4 0 0 1 1\n";
  const V3d point(0, 0, 1);
  for (const bool shut : {false, true}) {
    Traced room(std::string(kMaterials) + kFloor + (shut ? lid : "") + sun);
    const RadianceGuess guess = guessOf(room);
    const auto local = fitted(guess, room, point);
    EXPECT_EQ(local.expectsLight(), !shut);
    EXPECT_EQ(local.along(point, V3d(0, 0, -1)).color.y > 0, !shut);
  }
}

// A room of 4 x 4 x 3 m, a screen in it, and a panel or a lamp in a shade.
std::string furnished(const std::string& light) {
  return kMaterials + light +
         "gray polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\ngray polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 "
         "0 3\n"
         "gray polygon left 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\ngray polygon right 0 0 12 4 0 0 4 0 3 4 4 3 4 4 "
         "0\n"
         "gray polygon near 0 0 12 0 0 0 0 0 3 4 0 3 4 0 0\ngray polygon far 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"
         "gray polygon screen 0 0 12 1.5 1 0 3 1 0 3 1 1.8 1.5 1 1.8\n";
}
const std::string kPanel = "lamp polygon panel 0 0 12 1 1.5 2.9 1 2.5 2.9 2 2.5 2.9 2 1.5 2.9\n";
const std::string kShaded =
    "lamp sphere bulb 0 0 4 3 3 2.5 .05\ngray tube shade 0 0 7 3 3 2.4 3 3 2.7 .3\n"
    "gray cylinder outside 0 0 7 3 3 2.4 3 3 2.7 .302\n";

// The guess of indirect rays reduces their noise and does not change their mean: with one bounce and with
// several, aimed at bright spots or not, with one direction or with several at the first bounce.
TEST(RadianceGuess, OfIndirectRaysLeavesTheMeanAsItIs) {
  struct Case {
    const std::string* light;
    int bounces, divisions;
    double lessNoise, spoiled;
  };
  const V3d from(2.5, 2.5, 1.2);
  for (const Case& c : {Case{&kPanel, 1, 1, .5, 1.02}, Case{&kPanel, 3, 1, .7, 1.02},
                        Case{&kPanel, 2, 4, .6, 1.02}, Case{&kShaded, 2, 1, .9, 1.08}}) {
    RayOptions options = finely(c.bounces);
    options.ambientDivisions = c.divisions;
    options.weightLimit = .3;
    Traced room(furnished(*c.light), options);
    const RadianceGuess guess = guessOf(room);
    const LocalGuess local = fitted(guess, room, from, 64);
    ASSERT_GT(local.raysToGuess(0), 0);
    const BrightSpots spots(room.scene(), room.prepared().tracer(), room.prepared().lights());
    EXPECT_EQ(spots.empty(), c.light == &kPanel);
    PathTracer plain = room.tracerWith(Aims{nullptr, spots.empty() ? nullptr : &spots});
    PathTracer guessing = room.tracerWith(Aims{nullptr, spots.empty() ? nullptr : &spots});
    Sample without, with;
    const V3d to = V3d(-.3, .2, -1).normalized();  // the floor
    for (uint64_t i = 0; i < 8000; ++i) {
      without.add(plain.trace(from, to, 0, mixBits(i)).value.color.x);
      with.add(guessing.trace(from, to, 0, mixBits(i + 100000), {.guess = &local}).value.color.x);
    }
    const double error = std::hypot(with.standardError(), without.standardError());
    EXPECT_LT(std::abs(with.mean() - without.mean()), kMostSigmas * error) << *c.light << c.bounces;
    EXPECT_GT(std::abs(c.spoiled * with.mean() - without.mean()), kMostSigmas * error)
        << "would not see an error of " << c.spoiled;
    EXPECT_LT(with.standardError(), c.lessNoise * without.standardError()) << *c.light << c.bounces;
  }
}

// If -lr ends paths, the light beyond is not guessed.
TEST(RadianceGuess, EndsWherePathsDo) {
  for (const int limit : {1, -1}) {
    RayOptions options = finely(3);
    options.reflectionLimit = limit;
    options.weightLimit = 1e-3;
    Traced room(furnished(kPanel), options);
    const RadianceGuess guess = guessOf(room);
    const V3d from(2.5, 2.5, 1.2), to = V3d(-.3, .2, -1).normalized();
    const LocalGuess local = fitted(guess, room, from, 64);
    PathTracer guessing = room.transport().pathTracer();
    Sample without, with;
    for (uint64_t i = 0; i < 4000; ++i) {
      without.add(room.value(from, to, mixBits(i)));
      with.add(guessing.trace(from, to, 0, mixBits(i + 100000), {.guess = &local}).value.color.x);
    }
    const double error = std::hypot(with.standardError(), without.standardError());
    EXPECT_LT(std::abs(with.mean() - without.mean()), kMostSigmas * error) << limit;
    EXPECT_GT(std::abs(1.05 * with.mean() - without.mean()), kMostSigmas * error)
        << "would not see an error of 5%";
  }
}

}  // namespace
}  // namespace rsphere
