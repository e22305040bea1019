#include "field/irradiance_field.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/random.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// A lamp in the ceiling of a room of 4 m, and a thin wall that divides a dark part off.
constexpr const char* kRoom = R"(
void plastic wall 0 0 5 .5 .5 .5 0 0
void light lamp 0 0 3 10 10 10
lamp polygon ceiling_lamp 0 0 12 1 1 2.99 1 2 2.99 2 2 2.99 2 1 2.99
wall polygon floor 0 0 12 0 0 0 6 0 0 6 4 0 0 4 0
wall polygon ceiling 0 0 12 0 0 3 0 4 3 6 4 3 6 0 3
wall polygon south 0 0 12 0 0 0 0 0 3 6 0 3 6 0 0
wall polygon north 0 0 12 0 4 0 6 4 0 6 4 3 0 4 3
wall polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3
wall polygon east 0 0 12 6 0 0 6 0 3 6 4 3 6 4 0
wall polygon thin 0 0 12 4 0 0 4 4 0 4 4 3 4 0 3
wall sphere ball 0 0 4 1 3 .5 .3
)";

RayOptions interpolated(double accuracy, int bounces = 2) {
  RayOptions o = unbiased(bounces);
  o.directJitter = 0;
  o.ambientAccuracy = accuracy;
  o.ambientResolution = 64;
  o.ambientDivisions = 256;
  o.ambientSuperSamples = 0;
  return o;
}

// Light that arrives from a half space of radiance 1 + a.d, as a function of the direction d.
struct LinearLight {
  HemisphereCells cells{512};
  GatheredLight gather(const V3d& a, double distance) const {
    std::vector<Radiance> radiance(cells.count());
    const V3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    for (int i = 0; i < cells.count(); ++i)
      radiance[i] = Radiance(1 + a.dot(cells.direction(i, .5, .5, x, y, z)));
    return cells.sum(radiance, std::vector<double>(cells.count(), distance), 0, x, y, z);
  }
};

TEST(Hemisphere, SumsWhatIntegralsGive) {
  const LinearLight light;
  const GatheredLight flat = light.gather(V3d(0, 0, 0), 2);
  EXPECT_NEAR(flat.mean.x, 1, 1e-6);
  // Of a uniform sky, a share of (1 + cos) / 2 lies above a tilted surface.
  for (const double angle : {0., .3, .8, 1.5}) {
    const V3d tilted(std::sin(angle), 0, std::cos(angle));
    EXPECT_NEAR(flat.meanOfTilted(V3d(0, 0, 1), tilted).color.x, (1 + std::cos(angle)) / 2, 1e-5) << angle;
  }
  EXPECT_NEAR(flat.noise, 0, 1e-6);
  EXPECT_NEAR(flat.reach, 2, 1e-6);
  // The integrals of d_x^2 and of cos^2 over the hemisphere are two thirds of pi.
  const GatheredLight linear = light.gather(V3d(.3, -.2, .5), 2);
  EXPECT_NEAR(linear.mean.x, 1 + .5 * 2 / 3, .01);
  // The integral of L times the cosine to a tilted normal, by quadrature.
  const V3d tilted = V3d(.4, .3, .8).normalized();
  double sum = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double z = (i + .5) / kSteps, radius = std::sqrt(1 - z * z), angle = 2 * M_PI * (j + .5) / kSteps;
      const V3d d(radius * std::cos(angle), radius * std::sin(angle), z);
      sum += (1 + V3d(.3, -.2, .5).dot(d)) * std::max(0., d.dot(tilted)) * 2 / kSteps / kSteps;
    }
  EXPECT_NEAR(linear.meanOfTilted(V3d(0, 0, 1), tilted).color.x, sum, .01);
  // A large wall in +x is brighter, so that the light increases towards it.
  EXPECT_GT(linear.perLength[0].x, 0);
  EXPECT_LT(linear.perLength[0].y, 0);
}

// A ceiling at height 1 above a plane is bright where x > 0. The light at x is 1/2 + x / (2 sqrt(1 + x^2)),
// and its slope at 0 is a half.
TEST(Hemisphere, SlopeUnderHalfACeilingIsAHalf) {
  const HemisphereCells cells(4096);
  std::vector<Radiance> radiance(cells.count());
  std::vector<double> distance(cells.count());
  const V3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (int i = 0; i < cells.count(); ++i) {
    const V3d d = cells.direction(i, .5, .5, x, y, z);
    distance[i] = 1 / d.z;
    radiance[i] = Radiance(d.x > 0 ? 1 : 0);
  }
  const GatheredLight light = cells.sum(radiance, distance, 0, x, y, z);
  EXPECT_NEAR(light.mean.x, .5, .01);
  EXPECT_NEAR(light.perLength[0].x, .5, .03);
  EXPECT_NEAR(light.perLength[0].y, 0, .02);
}

TEST(Hemisphere, FindsTheCellOfItsDirections) {
  const HemisphereCells cells(100);
  const V3d x(0, 1, 0), y(0, 0, 1), z(1, 0, 0);
  for (int i = 0; i < cells.count(); ++i)
    for (const double u : {.01, .5, .99})
      EXPECT_EQ(cells.cellOf(cells.direction(i, u, 1 - u, x, y, z), x, y, z), i);
}

double relativeDifference(Traced& a, Traced& b, const V3d& origin, const V3d& direction) {
  const double expected = b.mean(origin, direction, 16).mean();
  return a.value(origin, direction) / expected - 1;
}

TEST(IrradianceField, AgreesWithWhatIsGatheredAnew) {
  Traced field(kRoom, interpolated(.15)), anew(kRoom, interpolated(0));
  double sum = 0;
  int count = 0;
  for (double x = .3; x < 3.9; x += .5)
    for (double y = .3; y < 4; y += .5) {
      const double error = relativeDifference(field, anew, V3d(x, y, 1.5), V3d(.1, .05, -1));
      EXPECT_LT(std::abs(error), .15) << x << ' ' << y;
      sum += error;
      ++count;
    }
  EXPECT_LT(std::abs(sum / count), .01);
  ASSERT_TRUE(field.transport().caches().field);
  EXPECT_GT(field.transport().caches().field->sitesMade(), 10u);
}

TEST(IrradianceField, LeavesTheDarkBehindAThinWall) {
  Traced field(kRoom, interpolated(.15));
  for (const double x : {4.001, 4.01, 4.1, 4.3, 5.}) {
    EXPECT_EQ(field.value(V3d(x, 2, 1), V3d(0, 0, -1)), 0) << x;
    EXPECT_GT(field.value(V3d(8 - x, 2, 1), V3d(0, 0, -1)), .05) << 8 - x;
  }
}

TEST(IrradianceField, AnswersTheSameInAnyOrderAndForAnyThread) {
  std::vector<V3d> places;
  Random random(5);
  for (int i = 0; i < 40; ++i)
    places.emplace_back(.2 + 3.6 * random.uniform(), .2 + 3.6 * random.uniform(), 1.5);
  const V3d down = V3d(.2, .1, -1).normalized();
  Traced forwards(kRoom, interpolated(.2)), shared(kRoom, interpolated(.2));
  std::vector<Color> expected;
  for (const V3d& p : places) expected.push_back(forwards.color(p, down, 7));
  const auto work = [&](bool backwards) {
    PathTracer tracer = shared.transport().pathTracer();
    for (size_t i = 0; i < places.size(); ++i) {
      const size_t k = backwards ? places.size() - 1 - i : i;
      EXPECT_EQ(tracer.trace(places[k], down, 0, 7).value.color, expected[k]);
    }
  };
  std::thread other(work, true);
  work(false);
  other.join();
}

// With a bound (-Sm) of a twentieth of the memory needed, several threads get the same values to the bit. The
// memory exceeds the bound by at most what the queries under way need.
TEST(IrradianceField, ForgetsBeyondItsBoundAndAnswersTheSame) {
  RayOptions o = interpolated(.18);
  o.ambientDivisions = 16;
  std::vector<V3d> places;
  for (double x = .15; x < 3.9; x += .3)
    for (double y = .15; y < 4; y += .6) places.emplace_back(x, y, 1.5);
  const V3d down = V3d(.2, .1, -1).normalized();
  constexpr size_t kTable = sizeof(void*) << 16;  // of a memory without a bound, before anything is in it
  Traced whole(kRoom, o);
  std::vector<Color> expected;
  for (const V3d& p : places) expected.push_back(whole.tracer().trace(p, down, 0, 7).value.color);
  const size_t needed = whole.transport().caches().field->bytes() - kTable;

  constexpr size_t kThreads = 3, kQuestion = 6'000;  // bytes
  o.fieldMemory = static_cast<double>(needed) / 20e6;
  Traced bounded(kRoom, o);
  IrradianceField& field = *bounded.transport().caches().field;
  const auto work = [&](size_t first) {
    PathTracer tracer = bounded.transport().pathTracer();
    for (size_t i = 0; i < places.size(); ++i) {
      const size_t k = (first + i) % places.size();
      EXPECT_EQ(tracer.trace(places[k], down, 0, 7).value.color, expected[k]);
      EXPECT_LT(field.bytes(), needed / 20 + kThreads * kQuestion);
    }
  };
  std::vector<std::thread> others;
  for (size_t i = 1; i < kThreads; ++i) others.emplace_back(work, i * 4);
  work(0);
  for (std::thread& other : others) other.join();
  EXPECT_GT(needed, 4 * kThreads * kQuestion) << "or nothing is told";
  EXPECT_GT(field.sitesMade(), 2 * whole.transport().caches().field->sitesMade())
      << "something was forgotten";
}

// Light of second diffuse surfaces has the same mean as with single paths, and less variance.
TEST(IrradianceField, TellsTheLightOfSecondSurfaces) {
  for (const int bounces : {2, 4}) {
    Traced field(kRoom, interpolated(.15, bounces)), anew(kRoom, interpolated(0, bounces));
    double got = 0, expected = 0;
    for (double x = .4; x < 3.9; x += .9)
      for (double z = .4; z < 3; z += .7) {
        got += field.value(V3d(x, 2, z), V3d(.1, -1, .05));
        expected += anew.mean(V3d(x, 2, z), V3d(.1, -1, .05), 5).mean();
      }
    EXPECT_NEAR(got / expected, 1, .015) << bounces;
    EXPECT_GT(std::abs(1.05 * got / expected - 1), .015) << "the spoiled twin";
  }
}

// The distance of a pane in a window is not that of the light seen through it: the gradient along a wall is
// that of a bright half space far outside.
TEST(IrradianceField, LooksThroughPanes) {
  const std::string room = R"(
void plastic wall 0 0 5 .5 .5 .5 0 0
void glow sky 0 0 4 10 10 10 0
sky source heaven 0 0 4 0 0 1 180
wall polygon south_low 0 0 12 0 0 0 0 0 1 6 0 1 6 0 0
wall polygon south_high 0 0 12 0 0 2 0 0 3 6 0 3 6 0 2
wall polygon north 0 0 12 0 4 0 6 4 0 6 4 3 0 4 3
wall polygon floor 0 0 12 0 0 0 6 0 0 6 4 0 0 4 0
wall polygon ceiling 0 0 12 0 0 3 0 4 3 6 4 3 6 0 3
)";
  const std::string pane = "void glass pane 0 0 3 1 1 1\npane polygon glass 0 0 12 0 0 1 6 0 1 6 0 2 0 0 2\n";
  RayOptions o = interpolated(.2, 1);
  o.ambientDivisions = 1024;
  Traced open(room, o), glazed(room + pane, o);
  for (double z = .3; z < 2.8; z += .35) {
    const V3d from(3, 2, z), towards(.05, 1, 0);
    const double expected = .92 * open.value(from, towards);
    EXPECT_NEAR(glazed.value(from, towards) / expected, 1, .12) << z;
  }
}

// The share of the light from above that a rectangle hides from a point: one corner is over the point at
// height c, and its sides are a and b (the form factor of a parallel rectangle).
double hiddenByCorner(double a, double b, double c) {
  const double x = a / c, y = b / c, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * M_PI);
}

// A plate of 2 m, .8 m above the ground: its shadow is found, however far the ground extends.
TEST(IrradianceField, FindsTheShadowOfAPlateOnAWideGround) {
  RayOptions finely = interpolated(.1, 1);
  finely.ambientResolution = 256;  // .23 m
  for (const double half : {10., 300.}) {
    Traced traced(fmt::format("void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
                              "void plastic gray 0 0 5 .4 .4 .4 0 0\n"
                              "gray polygon ground 0 0 12 -{0} -{0} 0 {0} -{0} 0 {0} {0} 0 -{0} {0} 0\n"
                              "gray polygon plate 0 0 12 2 -3 .8 4 -3 .8 4 -1 .8 2 -1 .8\n",
                              half),
                  finely);
    // Along the middle of the plate.
    for (const double x : {.5, 1.5, 2., 2.5, 3., 3.6, 4.2, 5.}) {
      const double hidden = 2 * (hiddenByCorner(4 - x, 1, .8) - hiddenByCorner(2 - x, 1, .8));
      EXPECT_NEAR(traced.value(V3d(x, -2, .02), V3d(0, 0, -1)), .4 * (1 - hidden), .1 * .4)
          << half << ": " << x;
    }
  }
}

// The share of the light from above that reaches a point below a plate of this size and at this height. The
// point is below the inside of the plate, this far from two of its edges.
double shareBelowPlate(double width, double depth, double height, double x, double y) {
  double hidden = 0;
  for (const double a : {x, width - x})
    for (const double b : {y, depth - y}) hidden += hiddenByCorner(a, b, height);
  return 1 - hidden;
}

// Two parallel boards close to each other: light comes from the sky through the gap alone, however far the
// ground below them extends. Interpolated light is not that of the places beside or above the boards.
TEST(IrradianceField, FindsTheLightInGapsOnAWideGround) {
  RayOptions coarse = interpolated(.1, 1);
  coarse.ambientDivisions = 2048;
  for (const double half : {3., 250., 2500.})
    for (const double gap : {.04, .015, .003}) {
      Traced traced(fmt::format("void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
                                "void plastic gray 0 0 5 .4 .4 .4 0 0\n"
                                "gray polygon ground 0 0 12 -{0} -{0} 0 {0} -{0} 0 {0} {0} 0 -{0} {0} 0\n"
                                "gray polygon lower 0 0 12 1 1 .7 1.6 1 .7 1.6 1.4 .7 1 1.4 .7\n"
                                "gray polygon upper 0 0 12 1 1 {1} 1 1.4 {1} 1.6 1.4 {1} 1.6 1 {1}\n",
                                half, .7 + gap),
                    coarse);
      // In heights of the gap from the edge.
      for (const double x : {.4, 1., 2., 3.}) {
        const double expected = .4 * shareBelowPlate(.6, .4, gap, x * gap, .2);
        const V3d from(1 + x * gap, 1.2, .7 + gap / 2);
        EXPECT_NEAR(traced.value(from, V3d(0, 0, -1)) / expected, 1, .2) << half << ": " << gap << ' ' << x;
      }
    }
}

// The light of a bright strip along the foot of a wall changes over a few centimetres of the floor. In a
// black room on a wide ground, the finest spacing of -ar is that of the room (1 cm), not of the ground
// (.8 m).
TEST(IrradianceField, FindsTheLightOfASkirtingOnAWideGround) {
  constexpr double kHeight = .05;
  RayOptions coarse = interpolated(.1, 1);
  coarse.ambientDivisions = 2048;
  for (const double half : {3., 250., 2500.}) {
    Traced traced(
        fmt::format("void glow g 0 0 4 1 1 1 0\nvoid plastic gray 0 0 5 .5 .5 .5 0 0\n"
                    "void plastic black 0 0 5 0 0 0 0 0\n"
                    "g polygon skirting 0 0 12 0 0 0 0 0 {0} 4 0 {0} 4 0 0\n"
                    "black polygon south 0 0 12 0 0 {0} 4 0 {0} 4 0 3 0 0 3\n"
                    "black polygon north 0 0 12 0 4 0 0 4 3 4 4 3 4 4 0\n"
                    "black polygon west 0 0 12 0 0 0 0 0 3 0 4 3 0 4 0\n"
                    "black polygon east 0 0 12 4 0 0 4 4 0 4 4 3 4 0 3\n"
                    "black polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"
                    "gray polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
                    "black polygon ground 0 0 12 -{1} -{1} -.3 {1} -{1} -.3 {1} {1} -.3 -{1} {1} -.3\n",
                    kHeight, half),
        coarse);
    for (const double y : {.01, .02, .04, .08, .15}) {
      const double expected = .5 * (1 - y / std::hypot(y, kHeight)) / 2;
      EXPECT_NEAR(traced.value(V3d(2, y, 1), V3d(0, 0, -1)) / expected, 1, .1) << half << ": " << y;
    }
  }
}

// A shelf over the ground is narrower than the sites of the ground are apart, and longer.
TEST(IrradianceField, FindsTheShadowOfANarrowShelfOnAWideGround) {
  for (const double height : {.3, .05, .01}) {
    RayOptions coarse = interpolated(.1, 1);
    coarse.ambientDivisions = 2048;
    Traced traced(fmt::format("void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
                              "void plastic gray 0 0 5 .4 .4 .4 0 0\n"
                              "gray polygon ground 0 0 12 -250 -250 0 250 -250 0 250 250 0 -250 250 0\n"
                              "gray polygon shelf 0 0 12 1 1 {0} 1.25 1 {0} 1.25 3 {0} 1 3 {0}\n",
                              height),
                  coarse);
    for (const double x : {.01, .03, .06, .12}) {
      const double expected = .4 * shareBelowPlate(.25, 2, height, x, 1);
      if (expected < .002) continue;  // too dark to be known by so few rays
      EXPECT_NEAR(traced.value(V3d(1 + x, 2, height / 2), V3d(0, 0, -1)) / expected, 1, .2)
          << height << ": " << x;
    }
  }
}

// A box of 2 m on the ground: the light from above that its walls do not occlude.
TEST(IrradianceField, FindsTheShadowOfABoxOnAWideGround) {
  for (const double half : {10., 300.}) {
    const std::string scene = fmt::format(
        "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
        "void plastic gray 0 0 5 .4 .4 .4 0 0\nvoid plastic black 0 0 5 0 0 0 0 0\n"
        "gray polygon ground 0 0 12 -{0} -{0} 0 {0} -{0} 0 {0} {0} 0 -{0} {0} 0\n"
        "black polygon west 0 0 12 2 -3 0 2 -3 2 2 -1 2 2 -1 0\n"
        "black polygon east 0 0 12 4 -3 0 4 -1 0 4 -1 2 4 -3 2\n"
        "black polygon south 0 0 12 2 -3 0 4 -3 0 4 -3 2 2 -3 2\n"
        "black polygon north 0 0 12 2 -1 0 2 -1 2 4 -1 2 4 -1 0\n"
        "black polygon top 0 0 12 2 -3 2 4 -3 2 4 -1 2 2 -1 2\n",
        half);
    RayOptions o = interpolated(0, 1), finely = interpolated(.1, 1);
    o.ambientDivisions = 4096;
    finely.ambientResolution = 256;
    Traced field(scene, finely), anew(scene, o);
    for (const double x : {4.05, 4.3, 4.8, 5.5, 7.}) {
      const V3d from(x, -2, .02), down(0, 0, -1);
      EXPECT_NEAR(field.value(from, down), anew.value(from, down), .1 * .4) << half << ": " << x;
    }
  }
}

// A sky of radiance 1, and a modifier `waves` for a gray material. It tilts the normal by this many degrees,
// in a direction that changes every few centimetres.
std::string wavesUnderASky(int degrees) {
  return fmt::format(
      "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
      "void texfunc waves 4 A1*cos(20*Px) A1*sin(20*Px) 0 . 0 1 {}\n"
      "waves plastic gray 0 0 5 .5 .5 .5 0 0\n",
      std::tan(degrees * M_PI / 180));
}

// Perturbed normals under a uniform sky, tilted in a direction that changes every few centimetres. No light
// arrives from behind the surface, nor from behind the perturbed normal. The result is the mean of upright
// and tilted, (1 + cos) / 2, however light is gathered.
TEST(IrradianceField, TiltedNormalsUnderAnEvenSky) {
  for (const int tilt : {0, 17, 45}) {
    const double angle = tilt * M_PI / 180;
    const std::string floor =
        wavesUnderASky(tilt) + "gray polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n";
    RayOptions o = interpolated(0, 1);
    o.ambientDivisions = 4096;
    Traced field(floor, interpolated(.1, 1)), anew(floor, o);
    const double expected = .5 * (1 + std::cos(angle)) / 2;
    for (const double x : {-3., .07, .2, .33, 2.})
      for (const V3d& to : {V3d(0, 0, -1), V3d(.3, -.2, -1)}) {
        const V3d from(x, .4, 1);
        EXPECT_NEAR(anew.value(from, to) / expected, 1, .01) << tilt << " degrees, anew";
        EXPECT_NEAR(field.value(from, to) / expected, 1, .01) << tilt << " degrees, interpolated";
      }
  }
}

// Beside a wall, tilted normals face it more or less. Interpolated light equals light gathered anew.
TEST(IrradianceField, TiltedNormalsBesideAWall) {
  for (const int tilt : {17, 45}) {
    const std::string floor = wavesUnderASky(tilt) +
                              "void plastic black 0 0 5 0 0 0 0 0\n"
                              "gray polygon floor 0 0 12 -3 -3 0 3 -3 0 3 2 0 -3 2 0\n"
                              "black polygon wall 0 0 12 -3 2 0 3 2 0 3 2 4 -3 2 4\n";
    RayOptions o = interpolated(0, 1), fine = interpolated(.1, 1);
    o.ambientDivisions = 4096;
    fine.ambientDivisions = 512;
    Traced field(floor, fine), anew(floor, o);
    for (const double x : {0., .07, .16, .24, .31}) {
      const V3d from(x, 1, 1), down(0, 0, -1);
      EXPECT_NEAR(field.value(from, down) / anew.value(from, down), 1, .06) << tilt << " degrees at " << x;
    }
  }
}

// -aw is ignored, because answers would depend on earlier ones. -av is the light of surfaces without computed
// light (-ae), and of the ends of paths.
TEST(IrradianceField, AmbientValueAndExcludedSurfaces) {
  RayOptions o = interpolated(.2);
  const V3d origin(2, 2, 1.5), down(.2, .1, -1);
  const double without = Traced(kRoom, o).value(origin, down);
  o.ambientWeight = 64;
  EXPECT_EQ(Traced(kRoom, o).value(origin, down), without);
  o.ambientValue = Radiance(1);
  EXPECT_GT(Traced(kRoom, o).value(origin, down), without);
  o.ambientBounces = 0;
  const double direct = Traced(kRoom, o).value(origin, down);
  o.ambientBounces = 2;
  o.ambientExcluded = {"wall"};
  EXPECT_NEAR(Traced(kRoom, o).value(origin, down), direct, 1e-6);
  o.ambientExcluded = {};
  o.ambientIncluded = {"lamp"};
  EXPECT_NEAR(Traced(kRoom, o).value(origin, down), direct, 1e-6);
}

// The indirect light of the floor is the ambient value (-ae, -aE), or that of all surfaces but the walls
// (-ai, -aI). On the walls the mean is the same as with light gathered anew, at first and at second surfaces.
// On the floor the values are the same to the bit.
TEST(IrradianceField, ExcludedSurfacesGiveTheAmbientValueToOthers) {
  std::string room = kRoom;
  const std::string_view floor = "wall polygon floor";
  room.replace(room.find(floor), floor.size(), "carpet polygon floor");
  room = "void plastic carpet 0 0 5 .9 .9 .9 0 0\n" + room;
  const auto with = [&](double accuracy, const std::vector<std::string>& excluded,
                        const std::vector<std::string>& included) {
    RayOptions o = interpolated(accuracy, 3);
    o.ambientValue = Radiance(.3);
    o.ambientExcluded = excluded;
    o.ambientIncluded = included;
    return o;
  };
  RayOptions many = with(0, {"carpet"}, {});
  many.ambientDivisions = 400;
  Traced anew(room, many), excluding(room, with(.15, {"carpet"}, {})),
      including(room, with(.15, {}, {"wall"})), all(room, with(.15, {}, {}));
  double expected = 0, got = 0, gotOfAll = 0;
  for (double x = .4; x < 3.9; x += .9)
    for (double z = .4; z < 3; z += .7) {
      const V3d from(x, 2, z), towards(.1, -1, .05);
      expected += anew.mean(from, towards, 8).mean();
      const double here = excluding.value(from, towards);
      EXPECT_EQ(including.value(from, towards), here);
      got += here;
      gotOfAll += all.value(from, towards);
    }
  EXPECT_NEAR(got / expected, 1, .01);
  EXPECT_GT(std::abs(gotOfAll / expected - 1), .03) << "the spoiled twin: computed on the floor as well";
  const V3d from(2, 2, 1.5), down(.2, .1, -1);
  EXPECT_EQ(excluding.value(from, down), anew.value(from, down));
  EXPECT_EQ(including.value(from, down), anew.value(from, down));
  EXPECT_NE(all.value(from, down), anew.value(from, down));
}

}  // namespace
}  // namespace rsphere
