// prism1 and prism2: plane surfaces that redirect light by functions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "tests/unit/transport/original_room.h"

namespace rsphere {
namespace {

constexpr double kRadius = .01, kRadiance = 1e5;
const V3d kLamp(1, .3, 2);

std::string lamp() {
  return fmt::format("void light bright 0 0 3 {0} {0} {0}\nbright sphere lamp 0 0 4 1 .3 2 {1}\n", kRadiance,
                     kRadius);
}
double irradianceBy(const V3d& lamp, const V3d& point) {
  const V3d to = lamp - point;
  return kRadiance * kPi * kRadius * kRadius * std::max(0., to.z) / std::pow(to.length(), 3);
}
double irradianceAt(Traced& traced, const V3d& point) {
  return traced.value(point + V3d(0, 0, 1.1e-4), V3d(0, 0, -1));
}
Traced meters(const std::string& scene) {
  RayOptions o;
  o.directThreshold = 0;
  return Traced(scene, o, IrradianceAt::point);
}

TEST(Prism, ThatReflectsIsAMirror) {
  Traced lit = meters(lamp() +
                      "void prism1 silver 5 .8 Dx+2*Rdot*Nx Dy+2*Rdot*Ny Dz+2*Rdot*Nz . 0 0\n"
                      "silver polygon pane 0 0 12 0 -9 -9 0 9 -9 0 9 9 0 -9 9\n");
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const V3d at(.1 + 3 * random.uniform(), 2 * random.uniform() - 1, 0);
    const double expected = irradianceBy(kLamp, at) + .8 * irradianceBy(V3d(-1, .3, 2), at);
    EXPECT_NEAR(irradianceAt(lit, at), expected, 2e-4 * expected) << at;
  }
}

// A window that changes only the brightness, with nothing around it.
TEST(Prism, ThatTurnsNothingIsAPane) {
  Traced lit = meters(lamp() +
                      "void prism1 pane 5 .8 Dx Dy Dz . 0 0\n"
                      "pane polygon window 0 0 12 .5 -.2 1 1.1 -.2 1 1.1 .5 1 .5 .5 1\n");
  Random random(2);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const V3d at(2 * random.uniform() - .5, 2 * random.uniform() - 1, 0);
    const V3d through = (at + kLamp) * .5;
    const bool seen = through.x > .5 && through.x < 1.1 && through.y > -.2 && through.y < .5;
    inside += seen;
    const double expected = (seen ? .8 : 1) * irradianceBy(kLamp, at);
    EXPECT_NEAR(irradianceAt(lit, at), expected, 2e-4 * expected) << at;
  }
  EXPECT_GT(inside, 30);
  EXPECT_LT(inside, 270);
}

// Ceilings that turn the sun's light: straight down, or down and along x, for the two of a prism2.
TEST(Prism, TurnsTheSunByItsFunctions) {
  const std::string sun = "void light bright 0 0 3 1e5 1e5 1e5\nbright source sun 0 0 4 3 1 4 .5\n";
  const std::string plane = "glazing polygon ceiling 0 0 12 -5 -5 2 5 -5 2 5 5 2 -5 5 2\n";
  const double sine = std::sin(.25 * kPi / 180), e = 1e5 * kPi * sine * sine;
  // Light from above goes on in the redirected direction; rays from below go on to the sun.
  const std::string down = "if(Dz,3,0) if(Dz,1,0) if(Dz,4,-1)", aside = "if(Dz,3,1) if(Dz,1,0) if(Dz,4,-1)";
  Traced one = meters(sun + "void prism1 glazing 5 .7 " + down + " . 0 0\n" + plane);
  EXPECT_NEAR(irradianceAt(one, V3d(0, 0, 0)), .7 * e, 1e-4 * e);
  EXPECT_NEAR(irradianceAt(one, V3d(-4.9, -4.9, 0)), .7 * e, 1e-4 * e);
  Traced two = meters(sun + "void prism2 glazing 9 .4 " + down + " .3 " + aside + " . 0 0\n" + plane);
  EXPECT_NEAR(irradianceAt(two, V3d(0, 0, 0)), (.4 + .3 / std::sqrt(2.)) * e, 1e-4 * e);
  // The light along x comes from a place that is 2 before, which lies outside of the ceiling here.
  EXPECT_NEAR(irradianceAt(two, V3d(-4.5, 0, 0)), .4 * e, 1e-4 * e);
  // A share of 0 makes no virtual source, and neither does a function that fails.
  Traced dark = meters(sun + "void prism1 glazing 5 0 " + down + " . 0 0\n" + plane);
  EXPECT_EQ(irradianceAt(dark, V3d(0, 0, 0)), 0);
  Traced failing = meters(sun + "void prism1 glazing 5 .7 1/(Dx-Dx) 0 1 . 0 0\n" + plane);
  EXPECT_EQ(irradianceAt(failing, V3d(0, 0, 0)), 0);
}

TEST(Prism, ShowsWhatItTurnsTo) {
  Traced scene(
      "void glow sky 0 0 4 2 3 4 0\nsky ring target 0 0 8 0 5 1 0 -1 0 0 .1\n"
      "void prism1 turner 9 .5 0 1 0 . -t 1 2 3 0 0\n"
      "turner ring window 0 0 8 0 0 1 -1 0 0 0 .5\n");
  const Color seen = scene.color(V3d(-3, 0, 1), V3d(1, 0, 0));
  EXPECT_NEAR((seen - Color(1, 1.5, 2)).rgb().length(), 0, 1e-12);
  EXPECT_EQ(scene.color(V3d(-3, 0, 1.7), V3d(1, 0, 0)), Color(0, 0, 0));
}

// In functions, DxA DyA DzA are the direction to the source that a shadow ray is aimed at, in the coordinates
// of the primitive; for other rays they are 0.
TEST(Prism, FunctionsKnowTheTarget) {
  Traced lit = meters(lamp() +
                      "void prism1 pane 7 1-.5*if(DxA*DxA+DyA*DyA+DzA*DzA-.5,1,0) Dx Dy Dz . -rx 90 0 0\n"
                      "pane polygon window 0 0 12 -5 -5 1 5 -5 1 5 5 1 -5 5 1\n");
  const V3d at(.3, .2, 0);
  EXPECT_NEAR(irradianceAt(lit, at), .5 * irradianceBy(kLamp, at), 1e-3);
}

TEST(Prism, AgreesWithTheOriginal) {
  expectFigures(kRoom +
                    "void light l 0 0 3 8 7 6\n"
                    "l polygon lamp 0 0 12 1.6 2.6 2.6 1.6 3.4 2.6 2.8 3.4 2.6 2.8 2.6 2.6\n"
                    "void prism2 p2 13 .4 Dx Dy+.3 Dz .5 Dx Dy-.2 Dz+.1 . -t 1 2 3 0 0\n"
                    "p2 ring pw2 0 0 8 1.2 2.5 1.2 1 .2 .1 0 1\n",
                {{{.64, 1.12, .43}, {.7, -1.71, -1.21}, {.06138422, .04805738, .04038435}},
                 {{1.38, 1.26, 1.21}, {.05, 1.18, -1.1}, {.06966984, .05454415, .04583542}},
                 {{.7, 4.54, .81}, {-1.1, -1.35, -2.08}, {.09305179, .07284976, .06121829}},
                 {{2.21, 4.68, .69}, {-1.49, -.9, .49}, {.1186285, .09287365, .07804509}},
                 {{.97, 1.81, 1.62}, {.75, .78, -1.27}, {.07938250, .06214814, .05222533}}});
}

}  // namespace
}  // namespace rsphere
