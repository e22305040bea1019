// Media and antimatter. Transmittance follows Beer and Lambert; single scattering is an integral along the
// ray (phase function: Henyey and Greenstein 1941).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "base/spectral_sampling.h"
#include "tests/unit/transport/original_room.h"

namespace rsphere::volumes_test {
namespace {

// A ball of mist around (x, 0, 0). arguments: as in a scene file, with the numbers of strings and reals.
std::string mist(const std::string& name, const std::string& arguments, double x = 0, double radius = 1) {
  return fmt::format("void mist {0} {1}\n{0} sphere {0}_ball 0 0 4 {2} 0 0 {3}\n", name, arguments, x,
                     radius);
}
// A wall of radiance 1 at x = 10.
const std::string kWall = "void glow white 0 0 4 1 1 1 0\nwhite ring wall 0 0 8 10 0 0 -1 0 0 0 5\n";
const V3d kEye(-5, 0, 0), kAhead(1, 0, 0);

RayOptions inMedium(const Color& extinction, const Color& albedo = Color(0, 0, 0)) {
  RayOptions o;
  o.mediumExtinction = extinction;
  o.mediumAlbedo = albedo;
  o.directThreshold = 0;
  return o;
}

void expectColor(const Color& got, const Color& expected) {
  EXPECT_NEAR((got - expected).rgb().length(), 0, 1e-9) << got.rgb() << " expected " << expected.rgb();
}
Color exponential(const Color& e) { return Color(std::exp(e.x), std::exp(e.y), std::exp(e.z)); }

TEST(Medium, AbsorbsAsBeerAndLambertSay) {
  const Color k(.1, .2, .4);
  Traced everywhere(kWall, inMedium(k));
  expectColor(everywhere.color(kEye, kAhead), exponential(-15. * k));
  Traced ball(kWall + mist("fog", "0 0 3 .1 .2 .4"));
  expectColor(ball.color(kEye, kAhead), exponential(-2. * k));
  // A ray that passes beside the middle, and one that starts inside.
  expectColor(ball.color(V3d(-5, .6, 0), kAhead), exponential(-1.6 * k));
  // Inside, the extinction is added to that of the medium everywhere, which is alone outside.
  Traced both(kWall + mist("fog", "0 0 3 .1 .2 .4"), inMedium(k));
  expectColor(both.color(kEye, kAhead), exponential(-17. * k));
  // A pattern multiplies it.
  Traced half("void brightfunc half 2 .5 . 0 0\n" + kWall +
              "half mist fog 0 0 3 .1 .2 .4\nfog sphere ball 0 0 4 0 0 0 1\n");
  expectColor(half.color(kEye, kAhead), exponential(-1. * k));
  // Surfaces without a material inside it change nothing.
  Traced divided(kWall + mist("fog", "0 0 3 .1 .2 .4") +
                 "void ring a 0 0 8 .5 0 0 1 0 0 0 1\n"
                 "void ring b 0 0 8 .7 0 0 1 0 0 0 1\n");
  expectColor(divided.color(kEye, kAhead), exponential(-2. * k));
}

// Beyond a mist that absorbs in some bands, they are absorbed no more.
TEST(Medium, EndsInAllBands) {
  RayOptions options;
  options.sampling = &spectralSampling(4, 380, 780);
  Traced ball("void spectrum tint 0 0 6 730 430 .1 .2 0 .4\n" + kWall +
                  "tint mist fog 0 0 3 1 1 1\nfog sphere ball 0 0 4 0 0 0 1\n" +
                  mist("gray", "0 0 3 1 1 1", 3, .5),
              options);
  const Bands seen = ball.color(kEye, kAhead).bands();
  for (size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(seen.values()[i], std::exp(-1 - 2 * std::array{.1, .2, 0., .4}[i]), 1e-9) << i;
}

TEST(Medium, VolumesWithinEachOtherAdd) {
  Traced nested(kWall + mist("outer", "0 0 3 .1 .1 .1", 0, 2) + mist("inner", "0 0 3 .3 .3 .3"));
  EXPECT_NEAR(nested.value(kEye, kAhead), std::exp(-.4 - .6), 1e-9);
  Traced overlapping(kWall + mist("first", "0 0 3 .1 .1 .1", 0, 2) + mist("second", "0 0 3 .3 .3 .3", 2, 2));
  EXPECT_NEAR(overlapping.value(kEye, kAhead), std::exp(-.4 - 1.2), 1e-9);
}

TEST(Medium, ScattersIndirectLight) {
  RayOptions o = inMedium(Color(.1, .2, .3), Color(.5, .6, .7));
  o.ambientValue = Radiance(2);
  Traced everywhere(kWall, o);
  const Color passed = exponential(Color(-1.5, -3, -4.5));
  expectColor(everywhere.color(kEye, kAhead), passed + Color(.5, .6, .7) * 2. * (Color(1, 1, 1) - passed));
  // The albedo of a mist applies inside of it. Beyond, in the mist around it, that of the outer mist applies.
  RayOptions clear;
  clear.ambientValue = Radiance(1);
  Traced nested(
      kWall + mist("outer", "0 0 6 .1 .1 .1 .5 .5 .5", 0, 2) + mist("inner", "0 0 6 .3 .3 .3 .9 .9 .9"),
      clear);
  double expected = 1;
  for (const auto& [depth, albedo] : {std::pair{.1, .5}, {.8, .9}, {.1, .5}})
    expected = expected * std::exp(-depth) + albedo * (1 - std::exp(-depth));
  EXPECT_NEAR(nested.value(kEye, kAhead), expected, 1e-9);
}

// Shadow rays are attenuated by absorption alone: in-scattering is assumed to replace out-scattered light.
TEST(Medium, DimsDirectLightByAbsorptionAlone) {
  const std::string lamp = "void light bright 0 0 3 1000 1000 1000\nbright sphere lamp 0 0 4 0 0 2 .01\n";
  const auto irradiance = [&](const std::string& more, const RayOptions& o) {
    return Traced(lamp + more, o, IrradianceAt::point).value(V3d(0, 0, -1.9999), V3d(0, 0, -1));
  };
  const double clear = irradiance("", {});
  EXPECT_NEAR(irradiance("", inMedium(Color(.1, .1, .1), Color(.75, .75, .75))) / clear,
              std::exp(-.025 * 3.99), 1e-4);
  EXPECT_NEAR(irradiance(mist("fog", "0 0 3 .1 .1 .1"), {}) / clear, std::exp(-.2), 1e-9);
  EXPECT_NEAR(irradiance(mist("fog", "0 0 6 .1 .1 .1 .75 .75 .75"), {}) / clear, std::exp(-.05), 1e-9);
}

// Light of a small ball, scattered once into a ray. Both lie within the mist.
struct Scattered {
  double extinction, albedo, eccentricity;
  V3d lamp{0, 1, .5};
  double share = 1;  // visible share of the lamp

  static constexpr double kRadius = .01, kRadiance = 1e4, kMist = 3;

  double along(const V3d& eye, const V3d& ahead, double begin, double end) const {
    constexpr int kSteps = 20000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = begin + (end - begin) * (i + .5) / kSteps;
      const V3d at = eye + t * ahead, to = lamp - at;
      const double d = to.length(), g = eccentricity;
      const double phase = (1 - g * g) / std::pow(1 + g * g - 2 * g * ahead.dot(to) / d, 1.5) / (4 * kPi);
      sum += extinction * albedo * phase * std::exp(-extinction * (t - begin)) * share * kRadiance * kPi *
             kRadius * kRadius / (d * d) * std::exp(-extinction * (1 - albedo) * d);
    }
    return sum * (end - begin) / kSteps;
  }
  std::string scene(const std::string& source = "lamp") const {
    return fmt::format("void light bright 0 0 3 {0} {0} {0}\nbright sphere lamp 0 0 4 0 1 .5 {1}\n",
                       kRadiance, kRadius) +
           mist("fog",
                fmt::format("1 {} 0 7 {e} {e} {e} {a} {a} {a} {}", source, eccentricity,
                            fmt::arg("e", extinction), fmt::arg("a", albedo)),
                0, kMist);
  }
};

TEST(Mist, ScattersLightOnce) {
  for (const Scattered& s : {Scattered{.2, .8, 0}, Scattered{.5, 1, .6}, Scattered{.1, .5, .9}}) {
    RayOptions o;
    o.mediumSampling = .5;
    Traced traced(s.scene(), o);
    expectMean(traced.mean(kEye, kAhead, 20000), s.along(kEye, kAhead, 2, 8), 1.02);
  }
}

// Only when a ray leaves the mist is it known to have started inside.
TEST(Mist, ScattersFromTheInside) {
  const Scattered s{.2, .8, .3};
  RayOptions o;
  o.mediumSampling = .2;
  Traced traced(s.scene(), o);
  expectMean(traced.mean(V3d(-1, 0, 0), kAhead, 20000), s.along(V3d(-1, 0, 0), kAhead, 0, 4), 1.02);
}

// -ms: more samples, the same mean.
TEST(Mist, SamplingDistanceChangesTheNoiseAlone) {
  const Scattered s{.2, .8, 0};
  RayOptions coarse, fine;
  fine.mediumSampling = .2;
  const Sample one = Traced(s.scene(), coarse).mean(kEye, kAhead, 40000);
  const Sample sixteen = Traced(s.scene(), fine).mean(kEye, kAhead, 2500);
  EXPECT_LT(std::abs(one.mean() - sixteen.mean()),
            kMostSigmas * std::hypot(one.standardError(), sixteen.standardError()));
  EXPECT_LT(sixteen.standardError(), one.standardError());
}

// A mist without arguments scatters with the properties of the surrounding medium, inside its volume alone.
TEST(Mist, MarksABeamInTheGlobalMedium) {
  Scattered s{.05, .9, .4};
  RayOptions o = inMedium(Color(.05, .05, .05), Color(.9, .9, .9));
  o.mediumEccentricity = .4;
  o.mediumSampling = .1;
  Traced traced("void light bright 0 0 3 1e4 1e4 1e4\nbright sphere lamp 0 0 4 0 1 .5 .01\n" +
                    mist("beam", "1 lamp 0 0", 0, .5),
                o);
  const double expected = s.along(kEye, kAhead, 4.5, 5.5) * std::exp(-.05 * 4.5);
  expectMean(traced.mean(kEye, kAhead, 4000), expected, 1.02);
}

TEST(Mist, ScattersRelayedLight) {
  const std::string mirror =
      "void mirror silver 0 0 3 .7 .7 .7\nsilver polygon glass 0 0 12 -90 3.5 -90 90 3.5 -90 90 3.5 90 -90 "
      "3.5 90\n";
  Scattered s{.1, 1, 0};
  s.lamp = V3d(0, 6, .5);
  s.share = .7;
  RayOptions o;
  o.mediumSampling = .3;
  Traced relayed(s.scene("glass>lamp") + mirror, o);
  expectMean(relayed.mean(kEye, kAhead, 4000), s.along(kEye, kAhead, 2, 8), 1.02);
  // An object in the way hides it.
  Traced hidden(s.scene("glass>lamp") + mirror +
                    "void plastic black 0 0 5 0 0 0 0 0\n"
                    "black polygon lid 0 0 12 -90 3.2 -90 90 3.2 -90 90 3.2 90 -90 3.2 90\n",
                o);
  EXPECT_EQ(hidden.value(kEye, kAhead), 0);
}

TEST(Mist, UnknownSourcesAreWarnedOf) {
  const Scene scene = sceneOf(Scattered{.1, 1, 0}.scene("sun") + kWall);
  std::vector<std::string> warnings;
  const rad::Warn warn = [&](std::string_view text) { warnings.emplace_back(text); };
  const Transport transport(scene, {}, IrradianceAt::none, false, warn);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("mist \"fog\": unknown source \"sun\""), std::string::npos) << warnings[0];
}

TEST(Mist, ThirtyTwoSourcesAtOnce) {
  std::string lamps = "void light bright 0 0 3 1 1 1\n", first = "20", second = "20";
  for (int i = 0; i < 40; ++i) {
    lamps += fmt::format("bright sphere lamp{} 0 0 4 {} 9 0 .1\n", i, i);
    (i < 20 ? first : second) += fmt::format(" lamp{}", i);
  }
  Traced apart(lamps + mist("a", first + " 0 6 .1 .1 .1 1 1 1") +
               mist("b", second + " 0 6 .1 .1 .1 1 1 1", 2.5));
  EXPECT_GT(apart.value(kEye, kAhead), 0);
  Traced nested(lamps + mist("a", first + " 0 3 .1 .1 .1") + mist("b", second + " 0 3 .1 .1 .1", 1));
  EXPECT_THROW(nested.value(kEye, kAhead), rad::Error);
}

// oconv room.rad mist.rad | rtrace -h -ab 0 -dj 0 -dt 0 -ds 0 -ss 0 -st 1 -lr 8 -dr 2 -dp 0 -me .1 .1 .1
// -ma .5 .6 .7 -mg .2 -ms .1 -av .1 .1 .1, means of 4000 answers, RADIANCE 6.1a.
TEST(Mist, AgreesWithTheOriginal) {
  RayOptions o = originalOptions();
  o.mediumExtinction = Color(.1, .1, .1);
  o.mediumAlbedo = Color(.5, .6, .7);
  o.mediumEccentricity = .2;
  o.mediumSampling = .1;
  o.ambientValue = Radiance(.1);
  Traced room(kRoom + kRoomMirrors + kRoomBall +
                  "void mist fog 1 lamp 0 7 .1 .2 .3 .9 .8 .7 .3\n"
                  "fog polygon fa 0 0 12 .5 .5 .1 .5 4.5 .1 3.5 4.5 .1 3.5 .5 .1\n"
                  "fog polygon fb 0 0 12 .5 .5 2.4 3.5 .5 2.4 3.5 4.5 2.4 .5 4.5 2.4\n"
                  "fog polygon fc 0 0 12 .5 .5 .1 3.5 .5 .1 3.5 .5 2.4 .5 .5 2.4\n"
                  "fog polygon fd 0 0 12 .5 4.5 .1 .5 4.5 2.4 3.5 4.5 2.4 3.5 4.5 .1\n"
                  "fog polygon fe 0 0 12 .5 .5 .1 .5 .5 2.4 .5 4.5 2.4 .5 4.5 .1\n"
                  "fog polygon ff 0 0 12 3.5 .5 .1 3.5 4.5 .1 3.5 4.5 2.4 3.5 .5 2.4\n"
                  "void mist fog2 1 lamp 0 6 .3 .3 .3 .9 .9 .9\n"
                  "fog2 sphere inner 0 0 4 3 4 1 .45\n",
              o);
  const std::vector<OriginalFigure> figures{{{1, 1.2, 2}, {.5, .3, -.6}, {.127749, .115582, .100746}},
                                            {{.2, .3, .4}, {1, 1.5, .5}, {.192753, .164681, .133666}},
                                            {{2, 2, 1}, {.3, .2, .1}, {.208653, .163229, .129860}},
                                            {{3.7, 4, 1.1}, {-1, 0, 0}, {.153743, .136188, .115906}}};
  for (const OriginalFigure& f : figures) {
    Color sum(0, 0, 0);
    for (uint64_t seed = 0; seed < 400; ++seed) sum += room.color(f.origin, f.direction, mixBits(seed));
    // The answers spread by .2% to .4%.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i] / 400, f.value[i], 1e-3 * f.value[i]) << f.origin;
  }
}

// ---- antimatter

constexpr const char* kBoards =
    "void glow red 0 0 4 1 0 0 0\nred polygon front 0 0 12 0 -1 -1 0 -1 1 0 1 1 0 1 -1\n"
    "void glow blue 0 0 4 0 0 1 0\nblue ring behind 0 0 8 5 0 0 -1 0 0 0 9\n";

TEST(Antimatter, MakesHoles) {
  Traced board(std::string(kBoards) +
               "void antimatter hole 2 void red 0 0\nhole sphere ball 0 0 4 0 0 0 .5\n");
  expectColor(board.color(kEye, kAhead), Color(0, 0, 1));
  expectColor(board.color(V3d(-5, .4, .2), kAhead), Color(0, 0, 1));
  expectColor(board.color(V3d(-5, .6, 0), kAhead), Color(1, 0, 0));
  // Surfaces with other modifiers are not cut away, nor are those with this one beyond the antimatter.
  Traced other(std::string(kBoards) +
               "void glow green 0 0 4 0 1 0 0\nvoid antimatter hole 2 void green 0 0\n"
               "hole sphere ball 0 0 4 0 0 0 .5\n");
  expectColor(other.color(kEye, kAhead), Color(1, 0, 0));
  Traced two(std::string(kBoards) +
             "red ring second 0 0 8 2 0 0 -1 0 0 0 1\n"
             "void antimatter hole 2 void red 0 0\nhole sphere ball 0 0 4 0 0 0 .5\n");
  expectColor(two.color(kEye, kAhead), Color(1, 0, 0));
}

// The cut is shaded with the first modifier, where the antimatter ends inside the volume.
TEST(Antimatter, ShowsTheCut) {
  const std::string block =
      "void glow red 0 0 4 1 0 0 0\nred sphere block 0 0 4 0 0 0 1\n"
      "void antimatter cut 1 red 0 0\ncut sphere ball 0 0 4 -1 0 0 .5\n";
  Traced scene(block);
  EXPECT_EQ(scene.seen(kEye, kAhead), "ball");
  expectColor(scene.color(kEye, kAhead), Color(1, 0, 0));
  const TracedRay ray = scene.tracer().trace(kEye, kAhead, 0, 1);
  EXPECT_NEAR(ray.unmirroredLength, 4.5, 1e-9);
  // A ray that only grazes the antimatter sees the block's own surface.
  EXPECT_NEAR(scene.tracer().trace(V3d(-5, .6, 0), kAhead, 0, 1).unmirroredLength, 4.2, 1e-9);
}

// A hollow in glass gives the same result whether antimatter cuts it or the glass has an inner surface.
TEST(Antimatter, OfADielectricRefractsAtTheHollowAsAnInnerSurfaceDoes) {
  std::string sky;
  Random placed(3);
  for (int i = 0; i < 12; ++i) {
    const V3d d = randomDirection(placed);
    sky += fmt::format("void glow g{0} 0 0 4 {1} {2} {3} 0\ng{0} source s{0} 0 0 4 {4} {5} {6} 50\n", i,
                       placed.uniform(), placed.uniform(), placed.uniform(), d.x, d.y, d.z);
  }
  const std::string ball = sky +
                           "void dielectric glass 0 0 5 .7 .8 .9 1.5 0\nglass sphere ball 0 0 4 0 0 0 1\n"
                           "void antimatter cut 1 glass 0 0\n";
  RayOptions o;
  o.reflectionLimit = 8;
  o.weightLimit = 1e-4;
  Traced cut(ball + "cut sphere hollow 0 0 4 .2 .1 0 .5\n", o);
  Traced inner(ball + "glass bubble hollow 0 0 4 .2 .1 0 .5\n", o);
  Traced full(ball, o);
  Random random(4);
  double change = 0;
  for (int i = 0; i < 500; ++i) {
    const V3d from = 3. * randomDirection(random), to = .8 * randomDirection(random);
    const Color expected = inner.color(from, to - from);
    EXPECT_NEAR((cut.color(from, to - from) - expected).rgb().length(), 0, 1e-6) << i;
    change += (full.color(from, to - from) - expected).rgb().length();
  }
  EXPECT_GT(change, 50);  // the hollow is hit
}

TEST(Antimatter, LetsLightThrough) {
  const std::string lit =
      "void light bright 0 0 3 1000 1000 1000\nbright sphere lamp 0 0 4 0 0 2 .01\n"
      "void plastic black 0 0 5 0 0 0 0 0\nblack ring lid 0 0 8 0 0 1 0 0 1 0 9\n";
  const std::string hole = "void antimatter hole 2 void black 0 0\nhole sphere ball 0 0 4 0 0 1 .2\n";
  const auto irradiance = [](const std::string& scene, double x) {
    return Traced(scene, {}, IrradianceAt::point).value(V3d(x, 0, 1.1e-4), V3d(0, 0, -1));
  };
  const double clear =
      irradiance("void light bright 0 0 3 1000 1000 1000\nbright sphere lamp 0 0 4 0 0 2 .01\n", 0);
  EXPECT_EQ(irradiance(lit, 0), 0);
  EXPECT_NEAR(irradiance(lit + hole, 0), clear, 1e-9 * clear);
  EXPECT_EQ(irradiance(lit + hole, .5), 0);
}

TEST(Antimatter, NamesThatAreNotThereAreWarnedOf) {
  std::vector<std::string> warnings;
  const std::string text =
      std::string(kBoards) + "void antimatter hole 2 void nothing 0 0\nhole sphere b 0 0 4 0 0 0 .5\n";
  sceneOf(text, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("antimatter \"hole\": unknown modifier \"nothing\""), std::string::npos);
}

TEST(Antimatter, ClipsSixtyFourModifiers) {
  const auto scene = [](int count) {
    std::string text, names;
    for (int i = 0; i < count; ++i) {
      text +=
          fmt::format("void glow g{0} 0 0 4 1 1 1 0\ng{0} ring r{0} 0 0 8 {1} 0 0 -1 0 0 0 1\n", i, .01 * i);
      names += fmt::format(" g{}", i);
    }
    return text + fmt::format("void antimatter all {} void{} 0 0\nall sphere ball 0 0 4 .3 0 0 2\n",
                              count + 1, names);
  };
  Traced most(scene(64));
  expectColor(most.color(kEye, kAhead), Color(0, 0, 0));
  EXPECT_THROW(sceneOf(scene(65)), rad::Error);
}

TEST(Antimatter, AgreesWithTheOriginal) {
  expectFigures(kRoom + kRoomBall +
                    "void antimatter cut 1 gloss 0 0\n"
                    "cut sphere c1 0 0 4 2.2 2.3 1.0 .3\n"
                    "void plastic block 0 0 5 .7 .2 .2 0 0\n"
                    "block sphere b2 0 0 4 1 1 1 .5\n"
                    "void antimatter hole2 2 void block 0 0\n"
                    "hole2 sphere h2 0 0 4 1.2 1 1.4 .3\n"
                    "hole2 cylinder h3 0 0 7 1 1 .3 1 1 1.7 .2\n"
                    "hole2 ring h4 0 0 8 1 1 .3 0 0 -1 0 .2\n"
                    "hole2 ring h5 0 0 8 1 1 1.7 0 0 1 0 .2\n",
                {{{.77, .85, .9}, {.36, .48, -.89}, {.1180117, .09239070, .07763924}},
                 {{1.93, 1.29, 1.25}, {-2.02, -.81, .7}, {.09122528, .07141979, .06001663}},
                 {{2.5, 1.96, .77}, {-1.06, .81, .02}, {.1773474, .1034615, .06651670}},
                 {{2.85, 2.42, 1.07}, {-.93, -.48, .14}, {.1101217, .08621369, .07244848}},
                 {{3, 3, 3}, {-2, -2, -2.1}, {.3295843, .08239608, .07062522}},
                 {{.3, 1, 1.6}, {1, 0, -.3}, {.1011716, .02529291, .02167964}}});
}

}  // namespace
}  // namespace rsphere::volumes_test
