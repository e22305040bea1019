#include "transport/surface_shading.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "tests/unit/transport/small_scenes.h"

namespace rsphere::surface_shading_test {
namespace {

using namespace small_scenes;

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

}  // namespace
}  // namespace rsphere::surface_shading_test
