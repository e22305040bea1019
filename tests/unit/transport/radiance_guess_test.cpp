#include "transport/radiance_guess.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"

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
LocalGuess fitted(const RadianceGuess& guess, const V3d& point) {
  Random random(5);
  std::vector<V3d> glances(128);
  for (V3d& d : glances) d = randomDirection(random);
  return guess.fit(point, glances, {}, 1);
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
    const auto local = fitted(guess, point);
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
  const auto local = fitted(guess, point);
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
    const auto local = fitted(guess, point);
    EXPECT_EQ(local.along(point, V3d(0, 0, -1)).color.y > 0, !shut);
  }
}

}  // namespace
}  // namespace rsphere
