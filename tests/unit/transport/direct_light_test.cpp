#include "transport/direct_light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/unit/transport/small_scenes.h"

namespace rsphere::direct_light_test {
namespace {

using namespace small_scenes;

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

// Beside a gather of 1024 rays, the shadow rays of its own surface are drawn 256 times for one source, or 16
// times if there are many. Nothing else sends light.
TEST(Direct, IsDrawnAgainForEachPartOfAGather) {
  const std::string scene =
      plastic("m", .5) + floor("m") + light(1) + "lamp polygon l\n0\n0\n12 -1 -1 .5 -1 1 .5 1 1 .5 1 -1 .5\n";
  RayOptions o = unbiased(0);
  o.sourceSubstructuring = 0;
  const V3d origin(1, 0, .3);
  const double once = Traced(scene, o).mean(origin, kDown, 2000).standardError();
  o.ambientBounces = 1;
  o.ambientDivisions = 1024;
  EXPECT_NEAR(Traced(scene, o).mean(origin, kDown, 2000).standardError() / once, 1. / 16, .008);
  std::string many = scene;
  for (int i = 0; i < 31; ++i) many += fmt::format("lamp sphere far{}\n0\n0\n4 {} 0 -50 1e-6\n", i, i);
  EXPECT_NEAR(Traced(many, o).mean(origin, kDown, 2000).standardError() / once, .25, .03);
  o.ambientDivisions = 4;
  EXPECT_NEAR(Traced(scene, o).mean(origin, kDown, 2000).standardError() / once, 1, .1);
}

}  // namespace
}  // namespace rsphere::direct_light_test
