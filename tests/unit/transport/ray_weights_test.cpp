// If indirect light is interpolated (-aa above 0), an ambient ray has half the weight of its parent, as in
// RADIANCE, regardless of their number (-ad). The limits of weight (-lw) and reflections (-lr) therefore end
// paths after some bounces, and take no light from bounces that are followed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/spectral_sampling.h"
#include "field/coarse_solution.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

struct Limits {
  int reflections;  // -lr
  double weight;    // -lw
};

RayOptions interpolated(int bounces, int divisions, const Limits& limits) {
  RayOptions o = unbiased(bounces);
  o.ambientAccuracy = .1;
  o.ambientResolution = 16;
  o.ambientDivisions = divisions;
  o.reflectionLimit = limits.reflections;
  o.weightLimit = limits.weight;
  return o;
}

std::string limitsIn(const Limits& l) { return fmt::format("-lr {} -lw {}", l.reflections, l.weight); }

TEST(RayWeights, LeaveTheWholeSky) {
  const std::string sky = "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n";
  for (const Limits& l : {Limits{6, .01}, Limits{6, .4}, Limits{8, 1e-4}, Limits{0, .01}, Limits{-8, .01}}) {
    Traced open(sky, interpolated(1, 512, l), IrradianceAt::point);
    EXPECT_NEAR(open.value(V3d(0, 0, 0), V3d(0, 0, 1)), std::numbers::pi, 1e-3) << limitsIn(l);
  }
  Traced ended(sky, interpolated(1, 512, {6, .6}), IrradianceAt::point);
  EXPECT_EQ(ended.value(V3d(0, 0, 0), V3d(0, 0, 1)), 0) << "half is less than the least weight";
}

// Walls that emit radiance .2 and have a reflectance of .4.
constexpr double kShine = .2, kReflects = .4;
constexpr const char* kWall = R"(
void plastic gray 0 0 5 .5 .5 .5 0 0
void glow shine 0 0 4 1 1 1 0
void mixfunc wall 4 gray shine .8 . 0 0
)";
const std::string kBox = roomOf("wall", V3d(2, 2, 2));

// The radiance in a furnace with this number of bounces.
double seriesTo(int bounces) {
  double sum = 0;
  for (int i = 0; i <= bounces; ++i) sum += kShine * std::pow(kReflects, i);
  return sum;
}

// The weight falls by .8 (of the mixture) times a half at each bounce: to .064 at the third.
TEST(RayWeights, LeaveEveryBounceInAFurnace) {
  struct Case {
    int bounces;
    Limits limits;
  };
  for (const auto& [bounces, limits] :
       {Case{2, {6, .1}}, Case{2, {-8, .1}}, Case{2, {0, .1}}, Case{3, {6, .05}}}) {
    Traced furnace(kWall + kBox, interpolated(bounces, 64, limits));
    EXPECT_NEAR(furnace.value(V3d(1, .9, 1.1), V3d(.2, .1, -1)) / seriesTo(bounces), 1, 4e-3)
        << bounces << " bounces, " << limitsIn(limits);
  }
}

// Light is not interpolated on the inside of a ball, and there are no patches. One view is through a small
// pane of glass, the other is past it.
TEST(RayWeights, LeaveSurfacesThatAreNotInterpolatedTheirLight) {
  const std::string ball = std::string(kWall) + "wall bubble room 0 0 4 0 0 0 3\n";
  const std::string pane = "void glass clear 0 0 3 .5 .5 .5\nclear ring pane 0 0 8 0 0 .1 0 0 1 0 .01\n";
  Traced glazed("void glow bright 0 0 4 1 1 1 0\nbright source all 0 0 4 0 0 1 360\n" + pane, unbiased());
  const double passed = glazed.value(V3d(0, 0, 0), V3d(0, 0, 1));
  ASSERT_LT(passed, .6);
  for (const Limits& l : {Limits{8, 1e-4}, Limits{-8, 1e-4}, Limits{8, 1e-3}}) {
    Traced room(ball + pane, interpolated(2, 2048, l));
    EXPECT_NEAR(room.value(V3d(0, 0, 0), V3d(0, 0, 1)) / (passed * seriesTo(2)), 1, 4e-3) << limitsIn(l);
    EXPECT_NEAR(room.value(V3d(0, 0, 0), V3d(0, 1, 0)) / seriesTo(2), 1, 4e-3) << limitsIn(l);
  }
}

// Diffuse reflections are included in the limit -lr, wherever light is gathered.
TEST(RayWeights, LimitOfReflectionsEndsBounces) {
  for (const int limit : {1, 2}) {
    Traced furnace(kWall + kBox, interpolated(3, 64, {limit, 1e-4}));
    EXPECT_NEAR(furnace.value(V3d(1, .9, 1.1), V3d(.2, .1, -1)) / seriesTo(limit), 1, 4e-3) << limit;
  }
}

// A gather follows weak sharp paths by Russian roulette. Two concentric balls reflect and transmit 40% each, so
// that every ray splits in two weak paths at every surface. In terms of the radiance of the sky, the radiance
// is a inwards and b outwards between the balls, and i within the inner one:
// a = .4 + .4 b, b = .4 i + .4 a, i = .4 a + .4 i.
struct GlazedGather {
  double mean = 0, standardError = 0;
};
GlazedGather gatherThroughBalls(int reflections) {
  const std::string scene =
      "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
      "void BRTDfunc layer 10 .4 .4 .4 .4 .4 .4 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0\n"
      "layer sphere inner 0 0 4 0 0 0 1\nlayer sphere outer 0 0 4 0 0 0 2\n";
  Sample sample;
  for (uint64_t rotation = 1; rotation <= 16; ++rotation) {
    RayOptions o = interpolated(1, 1024, {reflections, 1e-6});
    o.rotation = rotation;
    Traced glazed(scene, o, IrradianceAt::point);
    sample.add(glazed.value(V3d(0, 0, 0), V3d(0, 0, 1), rotation) / std::numbers::pi);
  }
  return {sample.mean(), sample.standardError()};
}

TEST(RayWeights, GathersFollowWeakSharpPathsByRoulette) {
  constexpr double kExpected = 4. / 11;
  const GlazedGather all = gatherThroughBalls(-100);
  ASSERT_LT(all.standardError, .01 * kExpected);
  EXPECT_NEAR(all.mean, kExpected, 4 * all.standardError);
  // Light is missing where paths end after a few reflections.
  const GlazedGather cut = gatherThroughBalls(-3);
  EXPECT_LT(cut.mean, kExpected - 4 * cut.standardError);
}

// In a spectral run, weights follow the band that is absorbed least. In these materials it is one band of 20, and
// the means of the channels are much darker. The rays are those of a scene where all bands are like that one.
struct Weighed {
  std::vector<double> weights;  // of the rays, in their order
  double seen = 0;              // radiance in the band that is absorbed least
};
constexpr size_t kClearBand = 12;
Weighed weighed(const std::string& material, const Limits& limits, double others, double atClear) {
  std::string spectrum = "void spectrum tint 0 0 22 770 390";
  for (size_t band = 0; band < 20; ++band)
    spectrum += fmt::format(" {}", band == kClearBand ? atClear : others);
  RayOptions options = unbiased();
  options.sampling = &spectralSampling(20, 380, 780);
  options.reflectionLimit = limits.reflections;
  options.weightLimit = limits.weight;
  Traced traced(spectrum + "\ntint " + material + "\nM sphere ball 0 0 4 0 0 0 1\n" +
                    "void glow g 0 0 4 1 1 1 0\ng sphere around 0 0 4 0 0 0 -4\n",
                options);
  Weighed w;
  const RayObserver observer = [&](const RayEnd& end, const RayResult&) {
    w.weights.push_back(end.context.weight);
  };
  const Color seen = traced.color(V3d(.3, .2, 3), V3d(0, 0, -1), 1, 0, {.observer = &observer});
  w.seen = seen.bandsIn(*options.sampling).values()[kClearBand];
  return w;
}

TEST(RayWeights, FollowTheBrightestBand) {
  struct Case {
    const char* material;
    double others, clear;  // the pattern in 19 bands, and in one
  };
  for (const auto& [material, others, clear] :
       {Case{"interface M 0 0 8 .99 .98 .97 1.4 .9 .96 .98 1.1", .05, 1},
        Case{"dielectric M 0 0 5 1 1 1 1.3 0", .05, 1}, Case{"glass M 0 0 3 .9 .9 .9", .05, 1},
        Case{"metal M 0 0 5 .9 .9 .9 .9 0", .05, 1}, Case{"mist M 0 0 3 1 1 1", 9, .2}})
    for (const Limits& limits : {Limits{8, .01}, Limits{-8, .01}}) {
      const Weighed all = weighed(material, limits, clear, clear);
      const Weighed one = weighed(material, limits, others, clear);
      ASSERT_EQ(one.weights.size(), all.weights.size()) << material;
      for (size_t i = 0; i < all.weights.size(); ++i)
        EXPECT_NEAR(one.weights[i], all.weights[i], 1e-12) << material << ", ray " << i;
      EXPECT_NEAR(one.seen, all.seen, 1e-12) << material;
      EXPECT_GT(one.seen, .3) << material;
    }
}

// Within a closed cylinder of metal paths branch at each surface. Its ceiling glows, so that there is a mean.
TEST(RayWeights, WorkWithinClosedMetalHasABoundAndTheSameMean) {
  RayOptions o = unbiased(6);
  o.ambientDivisions = 4;
  o.reflectionLimit = -10;
  o.weightLimit = 1e-5;
  Traced column(
      "void metal m 0 0 5 .8 .8 .8 .5 .1\nm cylinder column 0 0 7 0 0 0 0 0 1 .2\n"
      "m ring floor 0 0 8 0 0 0 0 0 1 0 .2\nvoid glow g 0 0 4 1 1 1 0\ng ring ceiling 0 0 8 0 0 1 0 0 -1 0 .2\n",
      o);
  PathTracer free = column.tracerWith({}), bound = column.tracerWith({}, {.boundsWork = true});
  const V3d from(.03, .02, .3), to = V3d(.6, .3, .4).normalized();
  const auto rays = [&](PathTracer& tracer) {
    size_t count = 0;
    const RayObserver observer = [&](const RayEnd&, const RayResult&) { ++count; };
    tracer.trace(from, to, 0, 7, {.observer = &observer});
    return count;
  };
  EXPECT_GT(rays(free), 1500u);
  EXPECT_LT(rays(bound), 700u);
  const auto mean = [&](PathTracer& tracer, uint64_t count, uint64_t seed) {
    Sample sample;
    for (uint64_t i = 0; i < count; ++i)
      sample.add(tracer.trace(from, to, 0, mixBits(seed + i)).value.color.x);
    return sample;
  };
  const Sample bounded = mean(bound, 1000, 1), all = mean(free, 120, 5000);
  EXPECT_LT(std::abs(bounded.mean() - all.mean()),
            kMostSigmas * std::hypot(bounded.standardError(), all.standardError()));
  EXPECT_LT(kMostSigmas * std::hypot(bounded.standardError(), all.standardError()), .15 * all.mean())
      << "would not see an error of 15%";
}

// Rays between two rough metal balls split at every hit, and reach all of the surfaces from nearby. With patches
// as fine as elsewhere there would be 50,000, each of them with the work of a thousand rays.
TEST(RayWeights, WorkBetweenShellsHasABound) {
  const std::string shells = R"(
void light l 0 0 3 100 100 100
l sphere lamp 0 0 4 0 0 4 .2
void metal rough 0 0 5 .8 .8 .8 .9 .1
rough sphere inner 0 0 4 0 0 4 .25
rough sphere outer 0 0 4 0 0 4 .3
)";
  RayOptions o = interpolated(2, 16, {-4, 1e-4});
  o.leastForPatches = 64;
  Traced between(shells, o);
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(between.value(V3d(0, 0, 4.275), V3d(.6, 0, .1 * i - .8).normalized()), 0);
  EXPECT_LT(between.transport().caches().coarse->patches(), 8000U);
}

// Balls of rough trans, the outer a third wider than the inner, whose patches and rays have bounds. The light that
// comes through them stays that of paths without interpolation.
TEST(RayWeights, LightThroughShellsOfRoughTransIsThatOfPaths) {
  const std::string shells = R"(
void light l 0 0 3 100 100 100
l sphere lamp 0 0 4 0 0 4 .2
void trans rough 0 0 7 .8 .8 .8 .1 .1 .8 .5
rough sphere inner 0 0 4 0 0 4 .25
rough sphere outer 0 0 4 0 0 4 .33
)";
  RayOptions o = interpolated(2, 16, {-4, 1e-4}), exact = unbiased(2);
  o.leastForPatches = 64;
  exact.ambientDivisions = 4;
  exact.reflectionLimit = -4;
  exact.weightLimit = 1e-4;
  Traced coarse(shells, o), paths(shells, exact);
  const V3d from(0, 0, 1), to = V3d(.04, .02, 1).normalized();
  const auto mean = [&](Traced& traced, uint64_t count) {
    PathTracer tracer = traced.tracerWith({});
    Sample sample;
    for (uint64_t i = 0; i < count; ++i) sample.add(tracer.trace(from, to, 0, mixBits(i)).value.color.x);
    return sample;
  };
  const Sample a = mean(coarse, 60), b = mean(paths, 200);
  EXPECT_LT(std::abs(a.mean() - b.mean()),
            .1 * b.mean() + kMostSigmas * std::hypot(a.standardError(), b.standardError()));
  EXPECT_LT(kMostSigmas * std::hypot(a.standardError(), b.standardError()), .2 * b.mean())
      << "would not see an error of 30%";
}

}  // namespace
}  // namespace rsphere
