// Interpolated indirect light (-aa above 0) stays on its side of walls, however thin they are and however
// large the scene is around them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// The corner of a room, the directions of its edges, and their lengths.
struct Room {
  V3d corner, x, y, z;
  V3d size{5, 4, 3};

  V3d at(double a, double b, double c) const {
    return corner + a * size.x * x + b * size.y * y + c * size.z * z;
  }
  V3d along(const V3d& direction) const { return direction.x * x + direction.y * y + direction.z * z; }
};

Room upright() { return {V3d(1, 2, 0), V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1)}; }
Room tilted() {
  const V3d x = V3d(.8, .5, -.2).normalized(), y = V3d(-.5, .8, .1), across = x.cross(y).normalized();
  return {V3d(3, 5, 1), x, across.cross(x), across};
}

std::string polygonOf(const std::string& name, const std::vector<V3d>& corners) {
  std::string text = "wall polygon " + name + " 0 0 " + std::to_string(3 * corners.size());
  for (const V3d& p : corners)
    for (int c = 0; c < 3; ++c) text += fmt::format(" {:.17g}", p[c]);
  return text + "\n";
}

// Walls, a ceiling and a table.
std::string wallsOf(const Room& r) {
  const auto p = [&](double a, double b, double c) { return r.at(a, b, c); };
  return polygonOf("ceiling", {p(0, 0, 1), p(0, 1, 1), p(1, 1, 1), p(1, 0, 1)}) +
         polygonOf("south", {p(0, 0, 0), p(0, 0, 1), p(1, 0, 1), p(1, 0, 0)}) +
         polygonOf("north", {p(0, 1, 0), p(1, 1, 0), p(1, 1, 1), p(0, 1, 1)}) +
         polygonOf("west", {p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1)}) +
         polygonOf("east", {p(1, 0, 0), p(1, 0, 1), p(1, 1, 1), p(1, 1, 0)}) +
         polygonOf("table", {p(.3, .3, .25), p(.6, .3, .25), p(.6, .6, .25), p(.3, .6, .25)});
}

std::string floorOf(const Room& r) {
  return polygonOf("floor", {r.at(0, 0, 0), r.at(1, 0, 0), r.at(1, 1, 0), r.at(0, 1, 0)});
}

// Sun, sky and bright ground.
constexpr const char* kOutdoors = R"(
void glow sky_glow 0 0 4 1 1 1 0
sky_glow source sky 0 0 4 0 0 1 180
void glow ground_glow 0 0 4 .5 .5 .5 0
ground_glow source ground 0 0 4 0 0 -1 180
void light sun_light 0 0 3 6e5 6e5 6e5
sun_light source sun 0 0 4 .4 -.5 .77 .533
void plastic wall 0 0 5 .7 .7 .7 0 0
)";

std::string groundAt(double height, double half) {
  return fmt::format("wall polygon ground 0 0 12 -{1} -{1} {0} {1} -{1} {0} {1} {1} {0} -{1} {1} {0}\n",
                     height, half);
}

struct Settings {
  int bounces;
  double accuracy;
  int resolution, divisions;
};

RayOptions optionsOf(const Settings& s) {
  RayOptions o = unbiased(s.bounces);
  o.directJitter = 0;
  o.ambientAccuracy = s.accuracy;
  o.ambientResolution = s.resolution;
  o.ambientDivisions = s.divisions;
  return o;
}

// The sum of radiance in random directions from random places in a room, and of the irradiance there.
double lightIn(const Room& room, const std::string& scene, const Settings& settings, int rays) {
  Traced radiance(scene, optionsOf(settings)), irradiance(scene, optionsOf(settings), IrradianceAt::point);
  Random random(11);
  double sum = 0;
  for (int i = 0; i < rays; ++i) {
    const V3d from = room.at(between(random, .02, .98), between(random, .02, .98), between(random, .02, .98));
    sum += radiance.value(from, randomDirection(random)) + irradiance.value(from, randomDirection(random));
  }
  return sum;
}

TEST(LightLeaks, NoneReachesAClosedRoomOfThinWalls) {
  const std::string farAway = "wall ring plate 0 0 8 2.5 -36 -.01 0 0 1 0 .1\n";
  struct Case {
    const char* name;
    Room room;
    std::string scene;
  };
  for (const Case& c :
       {Case{"something far away", upright(), wallsOf(upright()) + floorOf(upright()) + farAway},
        Case{"tilted walls on wide ground", tilted(),
             wallsOf(tilted()) + floorOf(tilted()) + groundAt(-4, 2500)},
        Case{"the ground is the floor", upright(), wallsOf(upright()) + groundAt(0, 8)}})
    for (const Settings& s : {Settings{2, .2, 64, 64}, Settings{4, .1, 256, 32}, Settings{2, .1, 300, 128}})
      EXPECT_EQ(lightIn(c.room, kOutdoors + c.scene, s, 8), 0)
          << c.name << ", -ab " << s.bounces << " -aa " << s.accuracy << " -ar " << s.resolution;
}

// A sill with a wall or pane of zero thickness on its middle, and the sky on one side. The plane of the wall
// passes through the centres of the sill's cells.
TEST(LightLeaks, EachSideOfAStandingPaneHasItsOwnLight) {
  const std::string sill = R"(
void glow sky_glow 0 0 4 1 1 1 0
sky_glow source sky 0 0 4 -1 0 0 90
void plastic gray 0 0 5 .5 .5 .5 0 0
gray polygon sill 0 0 12 -.1 -2 0 .1 -2 0 .1 2 0 -.1 2 0
pane polygon p 0 0 12 0 -2 0 0 -2 2 0 2 2 0 2 0
)";
  // The integral of the cosine over a cone of 45 degrees around the horizontal, over pi, above the sill.
  const double bright = .5 * (std::numbers::pi / 4 - .5) / std::numbers::pi;
  struct Case {
    const char* pane;
    double most;  // upper bound of the light behind it, relative to the light in front of it
  };
  for (const Case& c :
       {Case{"void plastic pane 0 0 5 0 0 0 0 0\n", 0}, Case{"void glass pane 0 0 3 .05 .05 .05\n", .05}})
    for (const double accuracy : {.1, .2}) {
      RayOptions o = optionsOf({1, accuracy, 128, 512});
      Traced traced(c.pane + sill, o);
      for (const double x : {.0005, .002, .01, .03, .09}) {
        EXPECT_NEAR(traced.value(V3d(-x, 0, 1), V3d(0, 0, -1)) / bright, 1, accuracy) << c.pane << -x;
        EXPECT_LE(traced.value(V3d(x, 0, 1), V3d(0, 0, -1)), c.most * bright) << c.pane << x;
      }
    }
}

}  // namespace
}  // namespace rsphere
