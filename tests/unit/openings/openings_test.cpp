#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"
#include "transport/find_aims.h"

namespace rsphere::openings_test {
namespace {

// A room of 4 x 4 x 3 m. Its south wall has a hole of 2 x 1 m, its roof one of .6 x .6 m.
constexpr const char* kRoom = R"(
void plastic gray 0 0 5 .5 .5 .5 0 0
void glass clear 0 0 3 .96 .96 .96
gray polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0
gray polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3
gray polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0
gray polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3
gray polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1 0 1 1 0 2 3 0 2 3 0 1 1 0 1
gray polygon roof 0 0 30 0 0 3 4 0 3 4 4 3 0 4 3 0 0 3 2.7 2.7 3 2.7 3.3 3 3.3 3.3 3 3.3 2.7 3 2.7 2.7 3
)";
const std::string kWindow = "clear polygon window 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n";
const std::string kHalves =
    "clear polygon west_half 0 0 12 1 0 1 2 0 1 2 0 2 1 0 2\nclear polygon east_half 0 0 12 2 0 1 3 0 1 3 0 "
    "2 2 0 2\n";
const std::string kSkylight = "clear polygon skylight 0 0 12 2.7 2.7 3 2.7 3.3 3 3.3 3.3 3 3.3 2.7 3\n";
const std::string kLid = "gray polygon lid 0 0 12 2.7 2.7 3 3.3 2.7 3 3.3 3.3 3 2.7 3.3 3\n";
const std::string kSky = "void glow sky_glow 0 0 4 1 1 1 0\nsky_glow source sky 0 0 4 0 0 1 360\n";

Openings openingsOf(const std::string& text) {
  Traced t(text, unbiased(1));
  return findOpenings(t.prepared());
}

// The radiance over the hemisphere that is expected from the openings.
double radianceAt(const Openings& openings, const V3d& point, const V3d& normal) {
  Openings::Aim aim;
  openings.aim({point, normal}, aim);
  return aim.mean;
}

// Whether a line from a point intersects the glass of the window, or of the skylight.
bool isInWindow(const V3d& point, const V3d& d) {
  if (!(d.y < 0)) return false;
  const V3d at = point - d * (point.y / d.y);
  return at.x > 1 - 1e-9 && at.x < 3 + 1e-9 && at.z > 1 - 1e-9 && at.z < 2 + 1e-9;
}
bool isInSkylight(const V3d& point, const V3d& d) {
  if (!(d.z > 0)) return false;
  const V3d at = point + d * ((3 - point.z) / d.z);
  return std::abs(at.x - 3) < .3 + 1e-9 && std::abs(at.y - 3) < .3 + 1e-9;
}

TEST(Openings, AreFoundWhereDaylightComesIn) {
  const V3d floor(2, 3.5, 0), up(0, 0, 1);
  const Openings window = openingsOf(kSky + kRoom + kLid + kWindow);
  ASSERT_FALSE(window.empty());
  // The form factor to the window, by numerical integration, times the diffuse transmittance of its pane.
  EXPECT_GT(radianceAt(window, floor, up), .01486 * .7);
  EXPECT_LT(radianceAt(window, floor, up), .01486 * .88);
  EXPECT_GT(window.inside(), .01) << "the sky lights the room";
  EXPECT_LT(window.inside(), .5);
  EXPECT_EQ(radianceAt(window, V3d(2, 3, 1), V3d(0, 1, 0)), 0) << "it is behind";
  EXPECT_EQ(radianceAt(window, V3d(2, -3, 0), up), 0) << "outdoors";
  // The openings do not depend on how the window is divided or which way its panes face.
  const Openings halves = openingsOf(kSky + kRoom + kLid + kHalves);
  const Openings turned =
      openingsOf(kSky + kRoom + kLid + "clear polygon window 0 0 12 1 0 1 1 0 2 3 0 2 3 0 1\n");
  for (const Openings* other : {&halves, &turned}) {
    EXPECT_NEAR(radianceAt(*other, floor, up), radianceAt(window, floor, up), .001);
    EXPECT_EQ(radianceAt(*other, V3d(2, -3, 0), up), 0);
  }
}

// A ground of 2 km was taken for the largest face of the scene, so that all openings of the room seemed too
// small. Means by daylight in this room then had four times the noise, and nine times on a ground of 1 km.
TEST(Openings, AreFoundOnAWideGround) {
  const std::string ground = "gray ring ground 0 0 8 0 0 -.02 0 0 1 0 1000\n";
  for (const std::string& panes : {std::string(), kWindow + kSkylight}) {
    const Openings openings = openingsOf(kSky + kRoom + panes + ground);
    EXPECT_GT(radianceAt(openings, V3d(2, 3.5, 0), V3d(0, 0, 1)), .01486 * .7) << panes;
    EXPECT_GT(radianceAt(openings, V3d(3, 3, 0), V3d(0, 0, 1)), .01) << panes << "below the skylight";
  }
}

// Sunlight on the floor makes the room so bright that the sky is only about twice as bright.
TEST(Openings, AreFoundAlthoughTheSunShinesIn) {
  const std::string sun = "void light sunlight 0 0 3 6e5 6e5 6e5\nsunlight source sun 0 0 4 0 -1 1 .53\n";
  EXPECT_FALSE(openingsOf(kSky + sun + kRoom + kLid + kWindow).empty());
}

// Sunlit blinds behind the pane are brighter than the sky, so that the room is the brighter side; but the sky
// is on the other.
TEST(Openings, AreFoundBehindSunlitBlinds) {
  std::string blinds = "void light sunlight 0 0 3 6e5 6e5 6e5\nsunlight source sun 0 0 4 0 -1 1 .53\n" +
                       std::string("void plastic white 0 0 5 .9 .9 .9 0 0\n");
  for (double z = .95; z < 2.05; z += .1)
    blinds += fmt::format("white polygon slat_{0:.2f} 0 0 12 .9 .05 {0} 3.1 .05 {0} 3.1 .13 {1} .9 .13 {1}\n",
                          z, z - .08);
  const Openings found = openingsOf(kSky + kRoom + kLid + kWindow + blinds);
  ASSERT_FALSE(found.empty());
  EXPECT_GT(radianceAt(found, V3d(2, 3.5, 0), V3d(0, 0, 1)), 0);
  EXPECT_EQ(radianceAt(found, V3d(2, -3, 0), V3d(0, 0, 1)), 0) << "outdoors";
}

// The window without its pane, and a doorway between several polygons.
TEST(Openings, AreHolesWithoutPanesToo) {
  const V3d floor(2, 3.5, 0), up(0, 0, 1);
  const Openings panes = openingsOf(kSky + kRoom + kLid + kWindow), holes = openingsOf(kSky + kRoom + kLid);
  ASSERT_FALSE(holes.empty());
  // The form factor to the window (see above); a hole is known to within a 64th of its wall.
  EXPECT_NEAR(radianceAt(holes, floor, up), .01486, .001);
  EXPECT_GT(radianceAt(holes, floor, up), 1.1 * radianceAt(panes, floor, up)) << "panes absorb light";
  EXPECT_EQ(radianceAt(holes, V3d(2, -3, 0), up), 0) << "outdoors";
  std::string pieces = kRoom;  // kRoom with a doorway
  const size_t south = pieces.find("gray polygon south");
  pieces.erase(south, pieces.find('\n', south) - south);
  const std::string pillars =
      "gray polygon south1 0 0 12 0 0 0 1 0 0 1 0 3 0 0 3\n"
      "gray polygon south2 0 0 12 3 0 0 4 0 0 4 0 3 3 0 3\n"
      "gray polygon south3 0 0 12 1 0 2 3 0 2 3 0 3 1 0 3\n";
  const Openings door = openingsOf(kSky + pieces + kLid + pillars);
  EXPECT_GT(radianceAt(door, floor, up), 1.2 * radianceAt(holes, floor, up))
      << "it reaches down to the floor";
}

// An overhang hides nearly all of the sky from the open window, which is lit by a sunlit ground. Points in
// such a room had 15 to 40% of noise in sphere mode: the window was no opening, so that only a few paths from
// the eye found its light.
TEST(Openings, AreHolesBelowAnOverhang) {
  const std::string outdoors =
      "void light sunlight 0 0 3 6e5 6e5 6e5\nsunlight source sun 0 0 4 0 .2 1 .53\n"
      "void glow sky_glow 0 0 4 1 1 1 0\nsky_glow source sky 0 0 4 0 0 1 180\n"
      "gray polygon overhang 0 0 12 -2 -2.5 2.05 6 -2.5 2.05 6 0 2.05 -2 0 2.05\n"
      "gray polygon ground 0 0 12 -50 -50 -.1 50 -50 -.1 50 50 -.1 -50 50 -.1\n";
  const Openings found = openingsOf(kRoom + kLid + outdoors);
  ASSERT_EQ(found.all().size(), 1u);
  EXPECT_GT(radianceAt(found, V3d(2, 3.5, 0), V3d(0, 0, 1)), .01486);
  EXPECT_EQ(radianceAt(found, V3d(2, -3, 0), V3d(0, 0, 1)), 0) << "outdoors";
}

// A pane behind a frame is 10 cm smaller than its hole on each side. The opening is the hole, but not where
// the gap is walled up.
TEST(Openings, AreAsWideAsTheGapsBesideTheirPanes) {
  const std::string pane = "clear polygon window 0 0 12 1.1 0 1.1 2.9 0 1.1 2.9 0 1.9 1.1 0 1.9\n";
  const std::string frame =
      "gray polygon frame 0 0 30 .9 .01 .9 3.1 .01 .9 3.1 .01 2.1 .9 .01 2.1 .9 .01 .9 1.1 .01 1.1 1.1 .01 "
      "1.9 2.9 .01 1.9 2.9 .01 1.1 1.1 .01 1.1\n";
  const std::string sill = "gray polygon sill 0 0 12 1 0 1 3 0 1 3 0 1.1 1 0 1.1\n";
  const auto sizeOf = [&](const std::string& more) {
    const Openings found = openingsOf(kSky + kRoom + kLid + pane + frame + more);
    EXPECT_EQ(found.all().size(), 1);
    const Opening& o = found.all()[0];
    EXPECT_NEAR(o.filled, 1.8 * .8, 1e-9) << "the area of the pane";
    EXPECT_NEAR(o.at(.5, .5).x, 2, .02);
    const Imath::V2d size =
        std::abs(o.x.x) > .5 ? Imath::V2d(o.width, o.height) : Imath::V2d(o.height, o.width);
    return std::pair(size, o.at(.5, .5).z);
  };
  const auto [whole, middle] = sizeOf("");
  EXPECT_NEAR(whole.x, 2, .03);
  EXPECT_NEAR(whole.y, 1, .03);
  EXPECT_NEAR(middle, 1.5, .02);
  const auto [part, raised] = sizeOf(sill);
  EXPECT_NEAR(part.x, 2, .03);
  EXPECT_NEAR(part.y, .9, .03);
  EXPECT_NEAR(raised, 1.55, .02);
}

// Both faces of a thick wall have a hole, but there is one way in.
TEST(Openings, AreOneInAThickWall) {
  const std::string outer =
      "gray polygon outer 0 0 30 0 -.2 0 4 -.2 0 4 -.2 3 0 -.2 3 0 -.2 0 1 -.2 1 1 -.2 2 3 -.2 2 3 -.2 1 1 "
      "-.2 1\n"
      "gray polygon sill 0 0 12 1 -.2 1 3 -.2 1 3 0 1 1 0 1\n"
      "gray polygon lintel 0 0 12 1 -.2 2 1 0 2 3 0 2 3 -.2 2\n"
      "gray polygon jamb1 0 0 12 1 -.2 1 1 0 1 1 0 2 1 -.2 2\n"
      "gray polygon jamb2 0 0 12 3 -.2 1 3 -.2 2 3 0 2 3 0 1\n";
  const V3d floor(2, 3.5, 0), up(0, 0, 1);
  const double thin = radianceAt(openingsOf(kSky + kRoom + kLid), floor, up),
               thick = radianceAt(openingsOf(kSky + kRoom + kLid + outer), floor, up);
  EXPECT_GT(thick, .6 * thin);
  EXPECT_LT(thick, 1.2 * thin);
}

// A ray that hits the pane reports the file; no other answer needs it.
TEST(Openings, AreNotAskedOfBsdfsWithoutTheirFile) {
  const std::string pane =
      "void BSDF missing 6 0 no_such_file.xml 0 0 1 . 0 0\n"
      "missing polygon window 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n";
  Traced t(kSky + kRoom + kLid + pane, unbiased(1));
  EXPECT_TRUE(findOpenings(t.prepared()).empty());
  EXPECT_THROW(t.value(V3d(2, 2, 1.5), V3d(0, -1, 0)), rad::Error);
  EXPECT_GE(t.value(V3d(2, 2, 1.5), V3d(0, 1, 0)), 0);
}

TEST(Openings, AreNotFoundElsewhere) {
  const std::string lamp = "void light lamp 0 0 3 10 10 10\nlamp sphere bulb 0 0 4 2 2 2 .1\n";
  const std::string shell = "gray bubble shell 0 0 4 2 2 1.5 8\n";
  EXPECT_TRUE(openingsOf("").empty());
  EXPECT_TRUE(openingsOf(kSky + kRoom + kWindow + kSkylight + shell).empty()) << "what is around is closed";
  EXPECT_TRUE(openingsOf(kRoom + kWindow).empty()) << "no sky";
  EXPECT_TRUE(openingsOf(kSky +
                         "void plastic gray 0 0 5 .5 .5 .5 0 0\nvoid glass clear 0 0 3 .96 .96 .96\n"
                         "gray polygon ground 0 0 12 -50 -50 0 50 -50 0 50 50 0 -50 50 0\n" +
                         kWindow)
                  .empty())
      << "a pane outdoors";
  EXPECT_TRUE(openingsOf("void plastic gray 0 0 5 .5 .5 .5 0 0\n" + lamp).empty());
  EXPECT_TRUE(openingsOf(lamp + kRoom + kSkylight).empty()) << "nothing receives the light that leaves";
}

// Aimed directions lead through the panes, and their density is density(): it integrates to 1 over all
// directions, and a function has the same mean with this density as over the sampled directions.
TEST(Openings, AreAimedAtAsDensitySays) {
  const Openings openings = openingsOf(kSky + kRoom + kWindow + kSkylight);
  ASSERT_FALSE(openings.empty());
  struct Case {
    V3d point, normal;
  };
  for (const Case& c : {Case{V3d(1.5, 3, 0), V3d(0, 0, 1)}, Case{V3d(0, 2.5, 1), V3d(1, 0, 0)}}) {
    Openings::Aim aim;
    openings.aim({c.point, c.normal}, aim);
    ASSERT_GT(aim.mean, 0);
    Random random(1);
    Sample whole, sampled, weighted, throughWindow;
    const auto some = [&](const V3d& d) { return 1.5 + d.x + (isInSkylight(c.point, d) ? 2 : 0); };
    for (int i = 0; i < 20000; ++i) {
      const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
      const V3d d = openings.sample(aim, u1, u2, u3);
      EXPECT_NEAR(d.length(), 1, 1e-12);
      EXPECT_TRUE(isInWindow(c.point, d) || isInSkylight(c.point, d));
      throughWindow.add(isInWindow(c.point, d));
      sampled.add(some(d));
    }
    for (int i = 0; i < 200000; ++i) {
      const V3d even = randomDirection(random);
      const double density = openings.density(aim, even);
      EXPECT_EQ(density > 0, isInWindow(c.point, even) || isInSkylight(c.point, even));
      whole.add(4 * std::numbers::pi * density);
      weighted.add(4 * std::numbers::pi * density * some(even));
    }
    EXPECT_GT(throughWindow.mean(), .1) << "or nothing is told";
    EXPECT_LT(throughWindow.mean(), .98) << "or nothing is told";
    expectMean(whole, 1, 1.15);
    const double error = std::hypot(sampled.standardError(), weighted.standardError());
    EXPECT_LT(std::abs(sampled.mean() - weighted.mean()), kMostSigmas * error);
    EXPECT_GT(std::abs(1.15 * sampled.mean() - weighted.mean()), kMostSigmas * error) << "the spoiled twin";
  }
}

TEST(Openings, ShowTheirAreaToLightOnItsWayIn) {
  const Openings window = openingsOf(kSky + kRoom + kLid + kWindow);
  const V3d in = V3d(.3, 1, -.5).normalized();
  EXPECT_NEAR(areaTowards(window.all(), V3d(0, 1, 0)), 2, 1e-9);
  EXPECT_NEAR(areaTowards(window.all(), in), 2 * in.y, 1e-9);
  EXPECT_EQ(areaTowards(window.all(), -in), 0) << "on its way out";
  const Openings both = openingsOf(kSky + kRoom + kWindow + kSkylight);
  EXPECT_NEAR(areaTowards(both.all(), in), 2 * in.y - .36 * in.z, 1e-9);
  Random random(1);
  Sample onWindow, x, z;
  for (int i = 0; i < 4000; ++i) {
    const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
    const V3d at = pointTowards(both.all(), in, u1, u2, u3);
    const bool isWindow = std::abs(at.y) < 1e-9;
    onWindow.add(isWindow);
    if (!isWindow) {
      EXPECT_NEAR(at.z, 3, 1e-9);
      continue;
    }
    EXPECT_TRUE(at.x >= 1 && at.x <= 3 && at.z >= 1 && at.z <= 2) << at;
    x.add(at.x);
    z.add(at.z);
  }
  expectMean(onWindow, 2 * in.y / areaTowards(both.all(), in), 1.05);
  expectMean(x, 2);
  expectMean(z, 1.5);
}

// A room of 8 x 6 x 4 m with a frosted skylight at the top of a shaft of half a metre.
constexpr const char* kRoomWithShaft = R"(
void plastic gray 0 0 5 .5 .5 .5 0 0
void plastic white 0 0 5 .85 .85 .85 0 0
void trans frosted 0 0 7 .85 .85 .85 0 0 .6 0
gray polygon floor 0 0 12 0 0 0 8 0 0 8 6 0 0 6 0
gray polygon west 0 0 12 0 0 0 0 6 0 0 6 4 0 0 4
gray polygon east 0 0 12 8 0 0 8 0 4 8 6 4 8 6 0
gray polygon north 0 0 12 0 6 0 8 6 0 8 6 4 0 6 4
gray polygon south 0 0 12 0 0 0 0 0 4 8 0 4 8 0 0
white polygon ceiling 0 0 30
  0 0 4 0 6 4 8 6 4 8 0 4 0 0 4 2.8 2.3 4 5.2 2.3 4 5.2 3.7 4 2.8 3.7 4 2.8 2.3 4
white polygon shaft1 0 0 12 2.8 2.3 4 2.8 2.3 4.5 5.2 2.3 4.5 5.2 2.3 4
white polygon shaft2 0 0 12 2.8 3.7 4 5.2 3.7 4 5.2 3.7 4.5 2.8 3.7 4.5
white polygon shaft3 0 0 12 2.8 2.3 4 2.8 3.7 4 2.8 3.7 4.5 2.8 2.3 4.5
white polygon shaft4 0 0 12 5.2 2.3 4 5.2 2.3 4.5 5.2 3.7 4.5 5.2 3.7 4
frosted polygon skylight 0 0 12 2.8 2.3 4.5 2.8 3.7 4.5 5.2 3.7 4.5 5.2 2.3 4.5
)";

TEST(Openings, AreSeenThroughTheMouthOfTheirShaft) {
  const Openings skylight = openingsOf(kSky + kRoomWithShaft);
  ASSERT_EQ(skylight.all().size(), 1);
  Random random(1);
  for (const auto& [point, normal, height] :
       {std::tuple(V3d(0, 3, 3.5), V3d(1, 0, 0), 4.), std::tuple(V3d(5, 3, 0), V3d(0, 0, 1), 4.),
        std::tuple(V3d(2.8, 3, 4.2), V3d(1, 0, 0), 4.5)}) {
    Openings::Aim aim;
    skylight.aim({point, normal}, aim);
    ASSERT_GT(aim.mean, 0) << point;
    Sample whole;
    for (int i = 0; i < 400000; ++i) {
      const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
      const V3d direction = skylight.sample(aim, u1, u2, u3);
      const V3d at = point + direction * ((height - point.z) / direction.z);
      ASSERT_TRUE(at.x > 2.799 && at.x < 5.201 && at.y > 2.299 && at.y < 3.701) << at;
      const double z = 2 * u1 - 1, angle = 2 * std::numbers::pi * u2, r = std::sqrt(1 - z * z);
      whole.add(4 * std::numbers::pi *
                skylight.density(aim, V3d(r * std::cos(angle), r * std::sin(angle), z)));
    }
    expectMean(whole, 1, 1.3);
  }
}

// A high place on a wall sees the walls of the shaft and nothing of the pane.
TEST(Openings, WithMouthsLeaveTheMeanAsItIs) {
  Traced room(kSky + kRoomWithShaft, unbiased(3));
  const Openings skylight = findOpenings(room.prepared());
  ASSERT_FALSE(skylight.empty());
  std::vector<Opening> panes(skylight.all().begin(), skylight.all().end());
  for (Opening& pane : panes) pane.mouth.reset();
  const Openings alone(panes, skylight.inside(), skylight.depth());
  PathTracer byMouth = room.tracerWith(Aims(&skylight)), byPane = room.tracerWith(Aims(&alone));
  const V3d origin(.5, 3, 3.5), west(-1, 0, 0);
  Sample with, without;
  for (uint64_t i = 0; i < 30000; ++i) {
    with.add(byMouth.trace(origin, west, 0, mixBits(i)).value.color.x);
    without.add(byPane.trace(origin, west, 0, mixBits(i + 1000000)).value.color.x);
  }
  const double error = std::hypot(with.standardError(), without.standardError());
  EXPECT_LT(std::abs(with.mean() - without.mean()), kMostSigmas * error);
  EXPECT_GT(std::abs(1.3 * with.mean() - without.mean()), kMostSigmas * error) << "the spoiled twin";
  EXPECT_LT(with.standardError(), .7 * without.standardError());
}

}  // namespace
}  // namespace rsphere::openings_test
