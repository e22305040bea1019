#include "transport/transport.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

const V3d kOrigin(0, 0, 0), kUp(0, 0, 1), kDown(0, 0, -1);

std::string plastic(const char* name, double reflectance) {
  return fmt::format("void plastic {}\n0\n0\n5 {r} {r} {r} 0 0\n", name, fmt::arg("r", reflectance));
}
std::string light(double radiance) {
  return fmt::format("void light lamp\n0\n0\n3 {r} {r} {r}\n", fmt::arg("r", radiance));
}
std::string glow(double radiance, double reach) {
  return fmt::format("void glow sky\n0\n0\n4 {r} {r} {r} {}\n", reach, fmt::arg("r", radiance));
}
// A horizontal square of half-size 10 that faces up.
std::string floor(const char* modifier, double z = 0, double half = 10, bool up = true) {
  const double a = up ? -half : half;
  return fmt::format("{} polygon floor\n0\n0\n12 {a} {n} {z} {b} {n} {z} {b} {p} {z} {a} {p} {z}\n", modifier,
                     fmt::arg("a", a), fmt::arg("b", -a), fmt::arg("n", -half), fmt::arg("p", half),
                     fmt::arg("z", z));
}
// Irradiance as with -I on the command line: the ray comes down to the point from a little above.
double irradianceAt(Traced& traced, const V3d& point, const V3d& normal, uint64_t seed = 1) {
  return traced.value(point + 1.1e-4 * normal, -normal, seed);
}

// ---- scenes without light

// Glow and an ambient value are light as well as lamps are.
TEST(Light, IsMissedOnlyWhereNothingCanGiveIt) {
  const std::string walls = plastic("paint", .5) + floor("paint");
  RayOptions ambient;
  ambient.ambientValue = Radiance(Color(0, .1, 0));
  EXPECT_TRUE(isDark(Traced(walls).prepared()));
  EXPECT_FALSE(isDark(Traced(walls, ambient).prepared()));
  EXPECT_FALSE(isDark(Traced(walls + light(1) + "lamp sphere bulb\n0\n0\n4 0 0 5 .5\n").prepared()));
  EXPECT_FALSE(isDark(Traced(walls + glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n").prepared()));
  EXPECT_TRUE(isDark(Traced(walls + light(1)).prepared()));  // not used
}

// ---- enclosures

TEST(Enclosure, OfGlowIsSeenAsItIs) {
  Traced box(glow(1, 0) +
             "sky polygon a\n0\n0\n12 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 -1\n"
             "sky polygon b\n0\n0\n12 -1 1 1 1 1 1 1 -1 1 -1 -1 1\n"
             "sky polygon c\n0\n0\n12 -1 -1 1 1 -1 1 1 -1 -1 -1 -1 -1\n"
             "sky polygon d\n0\n0\n12 1 1 -1 1 1 1 -1 1 1 -1 1 -1\n"
             "sky polygon e\n0\n0\n12 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1\n"
             "sky polygon f\n0\n0\n12 1 -1 1 1 1 1 1 1 -1 1 -1 -1\n");
  Random random(31);
  for (int i = 0; i < 5000; ++i)
    EXPECT_EQ(box.value(randomPoint(random, .99), randomDirection(random)), 1)
        << "hole or wrong side, ray " << i;
}

// A furnace: in uniform light of radiance 1, a surface that absorbs nothing has radiance 1.
TEST(Enclosure, FurnaceHidesWhatAbsorbsNothing) {
  const std::string sky = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  struct Case {
    std::string material;
    double lost;  // largest share that the model loses
  };
  for (const auto& [material, lost] :
       std::vector<Case>{{"void plastic m\n0\n0\n5 1 1 1 0 0\n", 0},
                         {"void trans m\n0\n0\n7 1 1 1 0 0 .5 0\n", 0},
                         {"void trans m\n0\n0\n7 1 1 1 0 0 .5 .5\n", 0},
                         {"void metal m\n0\n0\n5 1 1 1 1 0\n", 0},
                         {"void mirror m\n0\n0\n3 1 1 1\n", 0},
                         {"void glass m\n0\n0\n3 1 1 1\n", 0},
                         {"void dielectric m\n0\n0\n5 1 1 1 1.5 0\n", 0},
                         // Samples of a rough lobe that would leave under the surface are lost.
                         {"void metal m\n0\n0\n5 1 1 1 1 .05\n", .01}}) {
    Traced furnace(sky + material + "m sphere ball\n0\n0\n4 0 0 0 1\n", unbiased(40));
    const Sample seen = furnace.mean(V3d(0, .3, 3), V3d(0, 0, -1), 500);
    EXPECT_NEAR(seen.mean(), 1, lost + kMostSigmas * seen.standardError() + 1e-3) << material;
  }
}

// The integrating sphere: with -ab n a radiance ray sees L_n = L_inf (1 - q^(n+1)). By direct light, the
// radiance of the wall is p Ls (r/R)^2. The lamp, which is black to indirect rays, absorbs a share of (r/R)^2
// of the light that the wall reflects.
TEST(Enclosure, IntegratingSphereSumsItsGeometricSeries) {
  for (const double p : {.3, .8})
    for (const int bounces : {0, 1, 2, 8}) {
      const double share = .1 * .1, q = p * (1 - share), first = p * 100 * share;
      Traced sphere(plastic("wall", p) + light(100) +
                        "wall bubble s\n0\n0\n4 0 0 0 1\nlamp sphere l\n0\n0\n4 0 0 0 .1\n",
                    unbiased(bounces));
      const auto seen = [&](int n) { return first * (1 - std::pow(q, n + 1)) / (1 - q); };
      SCOPED_TRACE(testing::Message() << "reflectance " << p << ", -ab " << bounces);
      const bool countsOnce = std::pow(q, bounces + 1) > .01;
      expectMean(sphere.mean(V3d(.5, 0, 0), V3d(1, .2, .1), 40000), seen(bounces),
                 countsOnce ? seen(bounces + 1) / seen(bounces) : 1.02);
    }
}

// The light of glow without reach comes by indirect rays alone: a floor receives light of the sky with -ab 1,
// and none with -ab 0.
TEST(Ambient, FirstBounceMeetsGlow) {
  const double p = .5;
  const std::string scene =
      plastic("m", p) + floor("m", 0, 1000) + glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 180\n";
  EXPECT_EQ(Traced(scene, unbiased(0)).value(V3d(0, 0, 1), kDown), 0);
  for (const int bounces : {1, 2, 5})
    EXPECT_NEAR(Traced(scene, unbiased(bounces)).mean(V3d(0, 0, 1), kDown, 2000).mean(), p, 1e-12);
}

TEST(Ambient, ValueStandsForTheBouncesNotFollowed) {
  RayOptions o = unbiased(0);
  o.ambientValue = Radiance(Color(.5, .25, 1));
  const std::string wall = plastic("wall", .4) + "wall bubble s\n0\n0\n4 0 0 0 1\n";
  const Color seen = Traced(wall, o).color(kOrigin, V3d(1, .2, .1));
  EXPECT_NEAR(seen.x, .2, 1e-12);
  EXPECT_NEAR(seen.y, .1, 1e-12);
  EXPECT_NEAR(seen.z, .4, 1e-12);
  for (const int bounces : {1, 3}) {
    o.ambientBounces = bounces;
    EXPECT_NEAR(Traced(wall, o).mean(kOrigin, V3d(1, .2, .1), 200).mean(), .5 * std::pow(.4, bounces + 1),
                1e-9);
  }
}

TEST(Ambient, DivisionsLowerTheSpread) {
  const std::string scene =
      plastic("m", .5) + floor("m") + glow(1, 0) + "sky source part\n0\n0\n4 1 0 1 60\n";
  RayOptions o = unbiased(1);
  const Sample one = Traced(scene, o).mean(V3d(0, 0, 1), kDown, 20000);
  o.ambientDivisions = 256;
  const Sample many = Traced(scene, o).mean(V3d(0, 0, 1), kDown, 1000);
  // Irradiance of radiance 1 over a cone of 30 degrees half-angle at 45 degrees: E = pi sin^2(30) cos(45).
  const double expected = .5 * .25 * std::sqrt(.5);
  expectMean(one, expected, 1.1);
  expectMean(many, expected, 1.02);
  EXPECT_LT(many.standardError() * std::sqrt(1000.), one.standardError() * std::sqrt(20000.) / 16)
      << "stratified directions do better than as many independent ones";
}

TEST(Ambient, ExcludedSurfacesTakeTheAmbientValue) {
  const std::string scene =
      plastic("m", .5) + floor("m") + glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 180\n";
  RayOptions o = unbiased(1);
  o.ambientValue = Radiance(.125);
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .5, 1e-12);
  o.ambientExcluded = {"m"};
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .0625, 1e-12);
  o.ambientExcluded.clear();
  o.ambientIncluded = {"other"};
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .0625, 1e-12);
  o.ambientIncluded = {"m"};
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .5, 1e-12);
}

// ---- irradiance

TEST(Irradiance, OfSunSphereAndSky) {
  const double w = .533 * kPi / 180;
  Traced sun(light(1e6) + "lamp source s\n0\n0\n4 0 0 1 .533\n", {}, IrradianceAt::point);
  EXPECT_NEAR(irradianceAt(sun, kOrigin, kUp) / (1e6 * kPi * std::pow(std::sin(w / 2), 2)), 1, 1e-9);
  Traced ball(light(3) + "lamp sphere s\n0\n0\n4 0 0 2 .5\n", {}, IrradianceAt::point);
  EXPECT_NEAR(irradianceAt(ball, kOrigin, kUp), 3 * kPi / 16, 1e-3) << "the point lies 1e-4 higher";
  Traced sky(glow(1, 0) + "sky source s\n0\n0\n4 0 0 1 180\n", unbiased(1), IrradianceAt::point);
  EXPECT_NEAR(irradianceAt(sky, kOrigin, kUp), kPi, 1e-9);
  Traced noBounce(glow(1, 0) + "sky source s\n0\n0\n4 0 0 1 180\n", unbiased(0), IrradianceAt::point);
  EXPECT_EQ(irradianceAt(noBounce, kOrigin, kUp), 0) << "-I needs a bounce to see the sky";
  Sample upright;
  for (int i = 0; i < 4000; ++i) upright.add(irradianceAt(sky, kOrigin, V3d(1, 0, 0), mixBits(i)));
  expectMean(upright, kPi / 2, 1.1);
  Traced half(light(1) + "lamp source s\n0\n0\n4 0 0 1 180\n", {}, IrradianceAt::point);
  EXPECT_NEAR(irradianceAt(half, kOrigin, kUp), kPi, 1e-9);
}

// -i replaces the surface that is hit by a white meter. Glass is passed, and sources are not replaced.
TEST(Irradiance, AtTheSurfaceIsPiTimesRadianceOverReflectance) {
  const std::string scene = plastic("m", .25) + floor("m") + light(5) + "lamp sphere l\n0\n0\n4 3 0 4 .5\n";
  Traced radiance(scene), meters(scene, {}, IrradianceAt::surface);
  const V3d eye(0, 0, 2), aim(.1, .2, -1);
  EXPECT_NEAR(meters.value(eye, aim), radiance.value(eye, aim) * kPi / .25, 1e-12);
  Traced pane(scene + "void glass g\n0\n0\n3 .5 .5 .5\n" + floor("g", 1), {}, IrradianceAt::surface);
  Traced noPane(scene + "void glass g\n0\n0\n3 .5 .5 .5\n" + floor("g", 3), {}, IrradianceAt::surface);
  const double through = pane.value(eye, aim), below = noPane.value(eye, aim);
  EXPECT_NEAR(through / below, 1, 1e-9) << "the eye passes the pane; only the light is filtered by it";
  EXPECT_EQ(meters.value(eye, V3d(3, 0, 2)), 5) << "a lamp is seen as it is";
}

TEST(Irradiance, AtThePointEqualsThatAtTheSurface) {
  const std::string scene = plastic("m", .25) + floor("m") + light(5) + "lamp sphere l\n0\n0\n4 3 0 4 .5\n";
  Traced surface(scene, {}, IrradianceAt::surface), point(scene, {}, IrradianceAt::point);
  EXPECT_NEAR(surface.value(V3d(.5, .5, 1), kDown), irradianceAt(point, V3d(.5, .5, 0), kUp), 1e-3);
}

// ---- direct light

TEST(Direct, ShadowsAreDark) {
  const std::string scene = plastic("m", .5) + floor("m") + light(1) + "lamp sphere l\n0\n0\n4 0 0 4 .1\n";
  EXPECT_GT(Traced(scene).value(V3d(1, 0, 1), kDown), 0);
  EXPECT_EQ(Traced(scene + "m sphere ball\n0\n0\n4 .5 0 2 .4\n").value(V3d(1, 0, 1), kDown), 0);
}

TEST(Direct, LightIsFilteredByGlass) {
  const std::string scene = plastic("m", .5) + floor("m") + light(1) + "lamp sphere l\n0\n0\n4 0 0 4 .1\n" +
                            "void glass g\n0\n0\n3 .96 .96 .96\n";
  const double open = Traced(scene).value(V3d(0, 0, 1), kDown);
  EXPECT_NEAR(Traced(scene + floor("g", 3)).value(V3d(0, 0, 1), kDown) / open, .88, 2e-3);
}

// A board on a slab of glass: its shadow on the floor lies where refracted rays to the lamp hit the board.
// The lamp is a spotlight, for which no shadows are presumed (presumed_shadows.h).
TEST(Direct, RefractedPathDecidesAboutShadowsBehindASlab) {
  const double index = 1.5, lampX = 14, lampZ = 20, left = -1, right = .5;
  const std::string slab = fmt::format(
                               "void spotlight lamp\n0\n0\n7 1000 1000 1000 170 0 0 -1\n"
                               "lamp ring l\n0\n0\n8 {} 0 {} 0 0 -1 0 3\n",
                               lampX, lampZ) +
                           plastic("gray", .5) + floor("gray", 0) +
                           fmt::format("void dielectric glass\n0\n0\n5 1 1 1 {} 0\n", index) +
                           floor("glass", 1, 30, false) + floor("glass", 3, 30);
  const std::string board =
      fmt::format("gray polygon board\n0\n0\n12 {0} -5 4 {1} -5 4 {1} 5 4 {0} 5 4\n", left, right);
  RayOptions o;
  o.sourceSubstructuring = 0;
  Traced open(slab, o), covered(slab + board, o);
  int shadowed = 0;
  for (int i = 0; i < 400; ++i) {
    const double x = -6 + .0203 * i, slope = (lampX - x) / lampZ;
    // Two units of air and two of glass on the way to the board.
    const double within = slope / std::sqrt(1 + slope * slope) / index;
    const double over = x + 2 * slope + 2 * within / std::sqrt(1 - within * within);
    if (std::abs(over - left) < .02 || std::abs(over - right) < .02) continue;
    const bool dark = over > left && over < right;
    const double lit = open.value(V3d(x, 0, .5), kDown);
    EXPECT_GT(lit, 0);
    EXPECT_EQ(covered.value(V3d(x, 0, .5), kDown), dark ? 0 : lit) << x;
    shadowed += dark;
  }
  EXPECT_GT(shadowed, 50);
}

// A board hides a lamp on the straight line but not on the refracted path. The shadow ray lights the surface
// only if it hits the lamp.
TEST(Direct, RefractedShadowRaysLightWhereTheyMeetTheirSource) {
  const auto scene = [](double board, double lamp) {
    return fmt::format(
               "void spotlight lamp\n0\n0\n7 1e4 1e4 1e4 170 0 0 -1\nlamp ring l\n0\n0\n8 {} 0 6 0 0 -1 0 "
               ".5\n",
               lamp) +
           plastic("gray", .5) + floor("gray", 0) + "void dielectric glass\n0\n0\n5 1 1 1 1.5 0\n" +
           floor("glass", 1, 20, false) + floor("glass", 3, 20) +
           fmt::format("gray polygon board\n0\n0\n12 {0} -5 5 {1} -5 5 {1} 5 5 {0} 5 5\n", board, board + .5);
  };
  // The ray that is aimed at the middle of a lamp at x = 3 hits it at 2.6. The ray that is aimed at a lamp at
  // x = 6 misses it, at 5.1.
  const V3d from(0, .1, .5);
  const double open = Traced(scene(15, 3)).value(from, kDown);
  EXPECT_GT(open, 0);
  EXPECT_EQ(Traced(scene(2.25, 3)).value(from, kDown), open) << "on the straight line, which passes at 2.5";
  EXPECT_EQ(Traced(scene(1.75, 3)).value(from, kDown), 0) << "on the refracted line, which passes at 2.1";
  EXPECT_EQ(Traced(scene(15, 6)).value(from, kDown), 0) << "the refracted ray passes the lamp";
}

// Boards on a slab of glass in the sun, and places where a board is on the straight line to the sun but not
// on the refracted path. rtrace presumes that some of these places are in shadow. The values are those of
// rtrace (RADIANCE 6.1a, -dj 0 -ds 0).
TEST(Direct, ShadowsBehindASlabArePresumedAsByTheOriginal) {
  std::string text =
      "void light L 0 0 3 1000 1000 1000\nL source s 0 0 4 0.672716 -0.0749422 0.736096 .5\n"
      "void plastic w 0 0 5 .5 .5 .5 0 0\nw ring floor 0 0 8 0 0 0 0 0 1 0 20\n"
      "void dielectric d 0 0 5 1 1 1 1.45125 0\n"
      "d polygon lo 0 0 12 -20 -20 1 -20 20 1 20 20 1 20 -20 1\n"
      "d polygon hi 0 0 12 -20 -20 3 20 -20 3 20 20 3 -20 20 3\n";
  const double boards[][4] = {
      // the corners with the lowest and the highest coordinates
      {-2.02136, -0.0193731, -1.16215, 1.3232}, {-3.65716, 5.32073, -2.79092, 6.4219},
      {-5.66771, 2.8168, -4.56669, 3.54431},    {1.79378, 2.45042, 3.26787, 3.20032},
      {5.29007, 1.76808, 6.50545, 2.80513},     {1.07654, -5.72005, 1.64699, -4.40731},
      {0.223636, -4.2098, 1.5648, -3.70868},    {4.32184, -1.56527, 4.74012, -1.0955}};
  for (const auto& b : boards)
    text += fmt::format("w polygon b 0 0 12 {0} {1} 3.01 {2} {1} 3.01 {2} {3} 3.01 {0} {3} 3.01\n", b[0],
                        b[1], b[2], b[3]);
  RayOptions o;
  o.directThreshold = 0;
  o.directJitter = 0;
  o.sourceSubstructuring = 0;
  Traced scene(text, o);
  int dark = 0;
  const struct {
    V3d origin, direction;
    bool isLit;
  } rays[] = {{V3d(1.59403, -1.1059, 0.5), V3d(0.144058, -0.111173, -1), true},
              {V3d(-0.446318, 3.0947, 0.5), V3d(0.090193, 0.134912, -1), false},
              {V3d(-0.215792, 3.17271, 0.5), V3d(-0.0486241, 0.112781, -1), false},
              {V3d(-4.02399, 0.347452, 0.5), V3d(0.0195771, -0.00995128, -1), false},
              {V3d(-7.7779, 3.35794, 0.5), V3d(-0.165173, 0.038615, -1), true},
              {V3d(-1.18255, -5.13182, 0.5), V3d(-0.162908, -0.114462, -1), true},
              {V3d(-6.12959, 6.14846, 0.5), V3d(-0.106542, -0.06045, -1), false},
              {V3d(-5.68927, 5.90968, 0.5), V3d(0.0521273, -0.189778, -1), false},
              {V3d(-5.74565, 6.59789, 0.5), V3d(0.129485, 0.137936, -1), false},
              {V3d(-5.79414, 5.58534, 0.5), V3d(0.0827591, 0.139218, -1), true},
              {V3d(-1.34127, -4.04989, 0.5), V3d(-0.0416752, -0.132505, -1), true},
              {V3d(-4.77553, 1.13121, 0.5), V3d(0.094362, 0.0200696, -1), false},
              {V3d(-6.2087, 5.93348, 0.5), V3d(-0.0410068, 0.0247163, -1), false},
              {V3d(-1.27075, -4.90227, 0.5), V3d(0.155714, -0.0295357, -1), true},
              {V3d(-7.94958, 3.26198, 0.5), V3d(-0.0480734, -0.052682, -1), true},
              {V3d(3.45114, 2.53436, 0.5), V3d(-0.0907954, 0.148233, -1), false},
              {V3d(-3.40217, 0.594041, 0.5), V3d(0.133905, 0.188577, -1), false},
              {V3d(-0.371949, -4.89873, 0.5), V3d(-0.174383, 0.153201, -1), false},
              {V3d(0.169171, 2.42917, 0.5), V3d(0.115077, 0.160094, -1), true},
              {V3d(-1.53763, 7.13265, 0.5), V3d(0.0422814, 0.0932186, -1), true},
              {V3d(-5.79094, 1.59055, 0.5), V3d(-0.0778322, -0.141152, -1), true}};
  for (const auto& [origin, direction, isLit] : rays) {
    EXPECT_NEAR(scene.value(origin, direction), isLit ? 6.441884e-03 : 0, 1e-7) << origin;
    dark += !isLit;
  }
  EXPECT_GT(dark, 8);
}

// With -dt, most of many equal lamps are not tested. Their visibility is estimated from the tested ones.
TEST(Direct, ThresholdKeepsToItsShare) {
  std::string scene = plastic("m", .5) + floor("m") + light(1);
  for (int i = 0; i < 100; ++i)
    scene += fmt::format("lamp sphere l\n0\n0\n4 {} {} 5 {}\n", i % 10 - 4.5, i / 10 - 4.5, .01 + i * 1e-3);
  RayOptions o;
  o.directThreshold = 0;
  const double exact = Traced(scene, o).value(V3d(0, 0, 1), kDown);
  for (const double dt : {.03, .2}) {
    o.directThreshold = dt;
    EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), exact, 1e-9)
        << "nothing in the way: all are let through";
  }
}

// A roof hides the sun, which is tested first. The visibility of lamps that are too weak to be tested is
// estimated from the tested lamps: all are visible.
TEST(Direct, HiddenSunTakesNothingFromUntestedLamps) {
  std::string scene = plastic("m", .5) + floor("m") + floor("m", 6, 20) + light(1) +
                      "void light fire\n0\n0\n3 1e6 1e6 1e6\nfire source sun\n0\n0\n4 0 0 1 .5\n";
  for (int i = 0; i < 100; ++i)
    scene += fmt::format("lamp sphere l\n0\n0\n4 {} {} 5 .05\n", i % 10 - 4.5, i / 10 - 4.5);
  RayOptions o;
  o.directThreshold = 0;
  const double exact = Traced(scene, o).value(V3d(0, 0, 1), kDown);
  EXPECT_GT(exact, 0);
  o.directThreshold = .2;
  o.directCertainty = .5;
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), exact, 1e-9 * exact);
}

// Two lamps illuminate a floor, and a board hides a hundred weaker ones from most of it. After an indirect
// bounce the mean is the same as if all of them were tested.
TEST(Direct, ThresholdLeavesTheMeanBehindABounceAsItIs) {
  std::string scene = plastic("m", .5) + floor("m") + floor("m", 5, 3) + light(1) +
                      "lamp sphere left\n0\n0\n4 -6 0 6 .4\nlamp sphere right\n0\n0\n4 6 0 6 .4\n";
  for (int i = 0; i < 100; ++i)
    scene += fmt::format("lamp sphere weak\n0\n0\n4 {} {} 6 .06\n", (i % 10 - 4.5) / 3, (i / 10 - 4.5) / 3);
  RayOptions o = unbiased(1);
  const auto meanWith = [&](double threshold, int count) {
    o.directThreshold = threshold;
    o.directCertainty = 0;
    return Traced(scene, o, IrradianceAt::point).mean(V3d(0, 0, 2), -kDown, count);
  };
  const Sample all = meanWith(0, 20000);
  expectMean(meanWith(.5, 20000), all.mean(), 1.1);
}

// A roof hides the sun. The sun is weaker than the lamps under the roof, and therefore not among the
// brightest sources, which are always tested.
TEST(Direct, VisibleLampsTellNothingOfAHiddenSun) {
  std::string scene = plastic("m", .5) + floor("m") + floor("m", 6, 20) + light(1) +
                      "void light fire\n0\n0\n3 20 20 20\nfire source sun\n0\n0\n4 0 0 1 .5\n";
  for (int i = 0; i < 4; ++i) scene += fmt::format("lamp sphere l\n0\n0\n4 {} 0 5 .2\n", i - 1.5);
  RayOptions o;
  o.directThreshold = 0;
  const double exact = Traced(scene, o).value(V3d(0, 0, 1), kDown);
  EXPECT_GT(exact, 0);
  o.directThreshold = .07;
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), exact, 1e-9 * exact);
}

// ---- visibility of sources

TEST(Sources, VisibilityFollowsTheOption) {
  RayOptions hidden;
  hidden.sourcesVisible = false;
  const std::string ball = "lamp sphere l\n0\n0\n4 0 0 5 1\n";
  EXPECT_EQ(Traced(light(2) + ball).value(kOrigin, kUp), 2);
  EXPECT_EQ(Traced(light(2) + ball, hidden).value(kOrigin, kUp), 0);
  const std::string shine = plastic("m", .5) + floor("m") + light(2) + ball;
  EXPECT_EQ(Traced(shine, hidden).value(V3d(0, 0, 1), kDown), Traced(shine).value(V3d(0, 0, 1), kDown))
      << "what it lights stays lit";
  // Glow without reach is not a light source, and always visible. Glow with a reach is a source within it.
  const auto glowing = [&](double reach) {
    return Traced(glow(2, reach) + "sky sphere g\n0\n0\n4 0 0 5 1\n", hidden).value(kOrigin, kUp);
  };
  EXPECT_EQ(glowing(0), 2);
  EXPECT_EQ(glowing(3), 2) << "beyond its reach";
  EXPECT_EQ(glowing(10), 0);
  EXPECT_EQ(glowing(-1), 0);
}

// Two sources of 180 degrees, as gensky makes them, leave no gap between them. The angles are rtrace's: the
// first source of two is seen down to 2.8e-8 radians below its horizon.
TEST(Sources, RaysAlongTheHorizonBetweenTwoHemispheresSeeTheSky) {
  const std::string sky = "bright source sky\n0\n0\n4 0 0 1 180\n",
                    ground = "dim source ground\n0\n0\n4 0 0 -1 180\n";
  for (const std::string kinds : {"glow glow", "light light", "glow light", "light glow"}) {
    const bool skyGlows = kinds.starts_with("glow"), groundGlows = kinds.ends_with("glow");
    Traced scene(fmt::format("void {} bright\n0\n0\n{}\n{}void {} dim\n0\n0\n{}\n{}",
                             skyGlows ? "glow" : "light", skyGlows ? "4 8 8 8 0" : "3 8 8 8", sky,
                             groundGlows ? "glow" : "light", groundGlows ? "4 2 2 2 0" : "3 2 2 2", ground));
    // Where both are visible, one that is not glow hides the other.
    const double horizon = skyGlows && !groundGlows ? 2 : 8;
    for (double angle = 0; angle < 2 * kPi; angle += .1) {
      const auto at = [&](double z) {
        return scene.value(V3d(0, 0, 5), V3d(std::cos(angle), std::sin(angle), z));
      };
      EXPECT_EQ(at(0), horizon) << kinds << " " << angle;
      EXPECT_EQ(at(1e-12), horizon) << kinds << " " << angle;
      EXPECT_EQ(at(-1e-12), horizon) << kinds << " " << angle;
      EXPECT_EQ(at(-1e-8), horizon) << kinds << " " << angle;
      EXPECT_EQ(at(1e-5), 8) << kinds << " " << angle;
      EXPECT_EQ(at(-1e-5), 2) << kinds << " " << angle;
    }
  }
}

TEST(Sources, AreDarkFromBehind) {
  const std::string scene = light(2) + floor("lamp", 3);
  EXPECT_EQ(Traced(scene).value(V3d(0, 0, 5), kDown), 2);
  EXPECT_EQ(Traced(scene).value(kOrigin, kUp), 0);
  RayOptions o;
  o.backFacesVisible = false;
  EXPECT_EQ(Traced(scene + glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n", o).value(kOrigin, kUp), 1)
      << "-bv-: seen through from behind";
}

TEST(Sources, SpotlightIsSeenFromWithinItsConeOnly) {
  const std::string scene =
      "void spotlight s\n0\n0\n7 5 5 5 60 0 0 -1\ns ring r\n0\n0\n8 0 0 10 0 0 -1 0 .1\n";
  EXPECT_EQ(Traced(scene).value(kOrigin, kUp), 5);
  EXPECT_EQ(Traced(scene).value(V3d(5.5, 0, 0), V3d(-5.5, 0, 10)), 5);
  EXPECT_EQ(Traced(scene).value(V3d(6, 0, 0), V3d(-6, 0, 10)), 0);
}

// illum illuminates, but is not visible: the view shows its alternate, or passes through it.
TEST(Sources, IllumIsSeenAsItsAlternate) {
  const std::string before = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n" + plastic("gray", .5);
  for (const auto& [alternate, expected] : {std::pair("0", 1.), {"1 void", 1.}, {"1 black", 0.}}) {
    const std::string scene =
        before + plastic("black", 0) + fmt::format("void illum i\n{}\n0\n3 7 7 7\n", alternate);
    EXPECT_EQ(Traced(scene + floor("i", 3, 1, false)).value(kOrigin, kUp), expected) << alternate;
    // It lights the floor as a light of its radiance would.
    const std::string lamp = before + plastic("black", 0) + light(7);
    EXPECT_EQ(Traced(scene + floor("i", 3, 1, false) + floor("gray")).value(V3d(2, 0, 1), kDown),
              Traced(lamp + floor("lamp", 3, 1, false) + floor("gray")).value(V3d(2, 0, 1), kDown))
        << alternate;
  }
}

// ---- mirrors and media

TEST(Mirror, ShowsWhatItFaces) {
  Traced scene("void mirror m\n0\n0\n3 .9 .8 .7\n" + floor("m") + light(2) +
               "lamp sphere l\n0\n0\n4 3 0 3 .5\n");
  const Color seen = scene.color(V3d(-3, 0, 3), V3d(3, 0, -3));
  EXPECT_NEAR(seen.x, 1.8, 1e-12);
  EXPECT_NEAR(seen.z, 1.4, 1e-12);
  EXPECT_EQ(scene.value(V3d(0, 0, -1), kUp), 0) << "from behind it is black";
}

TEST(Mirror, GivesWayToItsAlternate) {
  const std::string sky = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  EXPECT_EQ(Traced(sky + "void mirror m\n1 void\n0\n3 .9 .9 .9\n" + floor("m")).value(V3d(0, 0, 1), kDown),
            1);
  EXPECT_EQ(Traced(sky + plastic("p", 0) + "void mirror m\n1 p\n0\n3 .9 .9 .9\n" + floor("m"))
                .value(V3d(0, 0, 1), kDown),
            0);
}

// There is no reflection along a straight path through a ball of index 1: the transmittance is exp(-a d).
TEST(Medium, AbsorbsByItsLength) {
  const std::string sky = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  Traced scene(sky + "void dielectric d\n0\n0\n5 .5 .9 1 1 0\nd sphere s\n0\n0\n4 0 0 0 1.5\n", unbiased());
  const Color seen = scene.color(V3d(0, 0, 5), kDown);
  EXPECT_NEAR(seen.x, .125, 1e-9);
  EXPECT_NEAR(seen.y, .729, 1e-9);
  EXPECT_NEAR(seen.z, 1, 1e-9);
  const Color inside = scene.color(V3d(0, 0, .5), kDown);
  EXPECT_NEAR(inside.x, .25, 1e-9) << "a ray that starts inside is told the medium by the surface it meets";
}

TEST(Medium, DielectricFocusesAsALensAndKeepsEnergy) {
  const std::string sky = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  Traced scene(sky + "void dielectric d\n0\n0\n5 1 1 1 1.5 0\nd sphere s\n0\n0\n4 0 0 0 1\n", unbiased());
  for (const double x : {0., .3, .6, .9}) EXPECT_NEAR(scene.value(V3d(x, 0, 5), kDown), 1, 1e-6);
}

// ---- limits

TEST(Limits, DistanceEndsTheRay) {
  Traced scene(light(2) + "lamp sphere l\n0\n0\n4 0 0 5 1\n" + glow(1, 0) +
               "sky source all\n0\n0\n4 0 0 1 360\n");
  EXPECT_EQ(scene.value(kOrigin, kUp, 1, 4.5), 2);
  EXPECT_EQ(scene.value(kOrigin, kUp, 1, 3.5), 0);
  EXPECT_EQ(scene.value(kOrigin, kDown, 1, 3.5), 0) << "the sky is farther";
  EXPECT_EQ(scene.value(kOrigin, kDown), 1);
}

// Between two facing mirrors a ray is reflected 5 times before it sees the sky.
TEST(Limits, ReflectionsAndWeightEndPathsWhereTheyAreTold) {
  const std::string scene = "void mirror m\n0\n0\n3 .5 .5 .5\n" + floor("m", -1) + floor("m", 1, 10, false) +
                            glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  const auto seen = [&](int reflectionLimit, double weightLimit) {
    RayOptions o;
    o.reflectionLimit = reflectionLimit;
    o.weightLimit = weightLimit;
    return Traced(scene, o).mean(V3d(0, 0, 0), V3d(1, 0, 1), 4000);
  };
  const double all = std::pow(.5, 5);
  EXPECT_NEAR(seen(5, 1e-4).mean(), all, 1e-12);
  EXPECT_EQ(seen(4, 1e-4).mean(), 0);
  EXPECT_NEAR(seen(-5, 1e-4).mean(), all, 1e-12);
  EXPECT_EQ(seen(-4, 1e-4).mean(), 0);
  EXPECT_NEAR(seen(0, 1e-4).mean(), all, 1e-12) << "0: no limit but the weight's";
  EXPECT_NEAR(seen(10, .03).mean(), all, 1e-12);
  EXPECT_EQ(seen(10, .04).mean(), 0) << "cut off";
  expectMean(seen(-10, .2), all, 1.3);
}

// The error occurs where a path would be subject to roulette, as in rtrace.
TEST(Limits, RussianRouletteNeedsAWeight) {
  const std::string lamp = light(1) + "lamp sphere bulb\n0\n0\n4 0 0 5 .5\n";
  RayOptions options;
  options.weightLimit = 0;
  Traced diffuse(lamp + plastic("paint", .5) + floor("paint"), options);
  EXPECT_GT(diffuse.value(V3d(0, 0, 1), kDown), 0);
  Traced mirror(lamp + "void metal paint\n0\n0\n5 .9 .9 .9 1 0\n" + floor("paint"), options);
  EXPECT_THROW(mirror.value(V3d(0, 0, 1), kDown), rad::Error);
  options.reflectionLimit = 4;
  Traced limited(lamp + "void metal paint\n0\n0\n5 .9 .9 .9 1 0\n" + floor("paint"), options);
  EXPECT_GT(limited.value(V3d(0, 0, 1), kDown), 0);
}

// rtrace -h -ld -op (6.1a): the end of a ray that hits nothing within its maximal length.
TEST(Limits, LimitedRaysEndWhereTheyAreLimited) {
  Traced empty(light(1) + "lamp sphere bulb\n0\n0\n4 0 0 5 .5\n");
  EXPECT_EQ(empty.tracer().cast(kOrigin, kUp, 3).point, V3d(0, 0, 3));
  EXPECT_EQ(empty.tracer().cast(kOrigin, kDown, 0).point, kOrigin);
  EXPECT_EQ(empty.tracer().cast(kOrigin, kUp, 7).point, V3d(0, 0, 4.5));
}

// Russian roulette may increase the variance, but does not change the mean.
TEST(Limits, RouletteKeepsTheMean) {
  const std::string scene =
      plastic("wall", .7) + light(100) + "wall bubble s\n0\n0\n4 0 0 0 1\nlamp sphere l\n0\n0\n4 0 0 .3 .1\n";
  const auto seen = [&](double weightLimit, int count) {
    RayOptions o = unbiased(12);
    o.weightLimit = weightLimit;
    return Traced(scene, o).mean(V3d(.5, 0, 0), V3d(1, .2, .1), count);
  };
  const Sample full = seen(1e-6, 20000);
  for (const double lw : {1e-2, .2}) {
    const Sample cut = seen(lw, 40000);
    const double error = std::hypot(full.standardError(), cut.standardError());
    EXPECT_LT(std::abs(cut.mean() - full.mean()), kMostSigmas * error) << "-lw " << lw;
    EXPECT_GT(.05 * full.mean(), kMostSigmas * error) << "5% would have been noticed";
  }
  // If survivors did not get a higher weight, the mean would be lower, as it is with -lr above 0.
  RayOptions o = unbiased(12);
  o.weightLimit = .2;
  o.reflectionLimit = 1000;
  const Sample spoiled = Traced(scene, o).mean(V3d(.5, 0, 0), V3d(1, .2, .1), 10000);
  EXPECT_LT(spoiled.mean(),
            full.mean() - kMostSigmas * std::hypot(full.standardError(), spoiled.standardError()));
}

// ---- order

TEST(PathTracer, AnswersDoNotDependOnWhatWasTracedBefore) {
  RayOptions o = unbiased(3);
  o.ambientDivisions = 16;
  const std::string scene = plastic("wall", .7) + "void metal m\n0\n0\n5 .8 .8 .8 .9 .1\n" + light(100) +
                            "wall bubble s\n0\n0\n4 0 0 0 1\nlamp sphere l\n0\n0\n4 0 0 .3 .1\n"
                            "m sphere ball\n0\n0\n4 .3 0 -.3 .2\n";
  Traced traced(scene, o);
  Random random(33);
  std::vector<std::pair<V3d, V3d>> rays;
  for (int i = 0; i < 50; ++i) rays.emplace_back(randomPoint(random, .2), randomDirection(random));
  std::vector<Color> forward;
  for (size_t i = 0; i < rays.size(); ++i)
    forward.push_back(traced.color(rays[i].first, rays[i].second, 100 + i));
  for (size_t i = rays.size(); i-- > 0;)
    EXPECT_EQ(traced.color(rays[i].first, rays[i].second, 100 + i), forward[i]);
  int same = 0;
  for (size_t i = 0; i < rays.size(); ++i)
    same += traced.color(rays[i].first, rays[i].second, 900 + i) == forward[i];
  EXPECT_LT(same, 25) << "other seeds, other answers";
}

}  // namespace
}  // namespace rsphere
