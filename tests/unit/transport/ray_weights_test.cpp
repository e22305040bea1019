// If indirect light is interpolated (-aa above 0), an ambient ray has half the weight of its parent, as in
// RADIANCE, regardless of their number (-ad). The limits of weight (-lw) and reflections (-lr) therefore end
// paths after some bounces, and take no light from bounces that are followed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/spectral_sampling.h"
#include "field/coarse_solution.h"
#include "field/tuning.h"
#include "tests/unit/transport/transport_fixture.h"
#include "transport/ray_limits.h"

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

// A gather follows weak sharp paths by Russian roulette. Two concentric balls reflect and transmit 40% each,
// so that every ray splits in two weak paths at every surface. In terms of the radiance of the sky, the
// radiance is a inwards and b outwards between the balls, and i within the inner one:
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

// In a spectral run, weights follow the band that is absorbed least. In these materials it is one band of 20,
// and the means of the channels are much darker. The rays are those of a scene where all bands are like that
// one.
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
      "m ring floor 0 0 8 0 0 0 0 0 1 0 .2\nvoid glow g 0 0 4 1 1 1 0\n"
      "g ring ceiling 0 0 8 0 0 1 0 0 -1 0 .2\n",
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

// Whatever the materials are, all rays of a patch together have a bounded number of descendants. Those that
// are followed make up for the others.
TEST(RayWeights, ThePathsOfAPatchHaveABound) {
  const Traced any("void light l 0 0 3 1 1 1\nl sphere lamp 0 0 4 0 0 4 .2\n",
                   interpolated(2, 16, {-100, 1e-9}));
  const int rays = 16, children = 100'000;
  PathState state;
  state.random = Random(1);
  state.descendants = descendantsOfPatch(rays, 0);
  PathContext ofPatch;
  ofPatch.weight = kMeanReflectance;
  ofPatch.depth = 1;
  ofPatch.ambientLevel = 1;
  const RayQuery query;
  const RayEnd parent(query, ofPatch);
  int followed = 0;
  double sum = 0;
  for (int i = 0; i < children; ++i) {
    NextRay child(parent, kReflected, Coefficient(Color(.9, .9, .9)));
    if (!goesOnAlong(child, any.prepared(), state)) continue;
    ++followed;
    sum += child.coefficient.color.x;
  }
  // The weight that a child needs grows with the square of the number: n^3 / 3 is as large as the children's.
  const double most = tuning::RayLimits::kFreely * rays;
  EXPECT_LT(followed, most * (2 + std::cbrt(3. * children / most)));
  EXPECT_GT(followed, most);
  EXPECT_NEAR(sum / children, .9, .9 * kMostSigmas / std::sqrt(followed / 3.));
}

// Each ray of a patch asks for a patch where it meets a diffuse surface: all of them together ask for many.
// There are 1266 in this room, 625 if the rays of a patch could only ask for some together, and 692 if each
// patch were asked for by Russian roulette.
TEST(RayWeights, EachRayOfAPatchAsksForAPatch) {
  RayOptions o = interpolated(2, 16, {-4, 1e-4});
  o.leastForPatches = 1024;
  Traced room("void plastic gray 0 0 5 .5 .5 .5 0 0\n" + roomOf("gray", V3d(2, 2, 2)) +
                  "void light l 0 0 3 9 9 9\nl sphere lamp 0 0 4 1.5 1.5 1.5 .1\n",
              o);
  PathTracer tracer = room.tracerWith({}, {FirstBounce::fromPatches, true, true});
  EXPECT_GT(tracer.trace(V3d(1, 1, 1), V3d(.3, .2, -1).normalized(), 0, 1).value.color.x, 0);
  EXPECT_GT(room.transport().caches().coarse->patches(), 950U);
}

// A room with a lamp and a window onto a wall outside. Light that the lamp sends out through the window is no
// daylight, for which surfaces are divided into several times as many patches.
TEST(RayWeights, AWindowByNightIsNoDaylight) {
  const std::string scene =
      "void plastic gray 0 0 5 .5 .5 .5 0 0\nvoid glass clear 0 0 3 .96 .96 .96\n"
      "gray polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
      "gray polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"
      "gray polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
      "gray polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"
      "gray polygon roof 0 0 12 0 0 3 4 0 3 4 4 3 0 4 3\n"
      "gray polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1 0 1 1 0 2 3 0 2 3 0 1 1 0 1\n"
      "clear polygon window 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n"
      "gray polygon outside 0 0 12 -4 -3 0 8 -3 0 8 -3 4 -4 -3 4\n"
      "void light l 0 0 3 9 9 9\nl sphere lamp 0 0 4 1.5 1.5 1.5 .1\n";
  const auto patchesIn = [](const std::string& text) {
    Traced room(text, interpolated(3, 64, {-4, 1e-4}));
    EXPECT_TRUE(room.transport().caches().aims.of<Openings>());
    EXPECT_GT(room.value(V3d(1, 1, 1), V3d(.3, .2, -1).normalized()), 0);
    return room.transport().caches().coarse->patches();
  };
  const std::string sky = "void glow dim 0 0 4 .01 .01 .01 0\ndim source sky 0 0 4 0 0 1 180\n";
  const size_t byNight = patchesIn(scene), byDay = patchesIn(scene + sky);
  EXPECT_LT(2 * byNight, byDay) << byNight << ' ' << byDay;
}

// Rays between two rough metal balls split at every hit, and reach all of the surfaces from nearby. With
// patches as fine as elsewhere there would be 50,000, each of them with the work of a thousand rays.
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

// Surfaces that reflect and transmit in lobes ask for patches at every hit. A gather's rays ask for weak
// ones, and follow weak paths, by Russian roulette. All of the light of a sky must still come through two
// boxes of rough trans.
std::string boxOf(const std::string& modifier, double half) {
  std::string box;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half, half}) {
      box += modifier + fmt::format(" polygon {}{} 0 0 12", axis, side);
      for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        V3d corner;
        corner[axis] = side;
        corner[(axis + 1) % 3] = u * half;
        corner[(axis + 2) % 3] = v * half;
        box += fmt::format(" {} {} {}", corner.x, corner.y, corner.z);
      }
      box += "\n";
    }
  return box;
}

TEST(RayWeights, LightThroughBoxesOfRoughTransIsThatOfPaths) {
  const std::string boxes =
      "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
      "void trans rough 0 0 7 .9 .9 .9 .1 .1 .8 .5\n" +
      boxOf("rough", .5) + boxOf("rough", .8);
  RayOptions o = interpolated(2, 16, {-4, 1e-4}), exact = unbiased(2);
  o.leastForPatches = 64;
  exact.ambientDivisions = 1;
  exact.reflectionLimit = -4;
  exact.weightLimit = 1e-4;
  Traced coarse(boxes, o), paths(boxes, exact);
  const auto mean = [](PathTracer tracer, uint64_t count) {
    Sample sample;
    for (uint64_t i = 0; i < count; ++i) {
      Random random(mixBits(i));
      const double z = 2 * random.uniform() - 1, around = 2 * std::numbers::pi * random.uniform();
      const V3d to(std::sqrt(1 - z * z) * std::cos(around), std::sqrt(1 - z * z) * std::sin(around), z);
      sample.add(tracer.trace(V3d(.1, .05, 0), to, 0, mixBits(count + i)).value.color.x);
    }
    return sample;
  };
  const Sample a = mean(coarse.tracerWith({}, {FirstBounce::fromPatches, true, true}), 1500),
               b = mean(paths.tracerWith({}), 1000);
  const double chance = kMostSigmas * std::hypot(a.standardError(), b.standardError());
  EXPECT_LT(std::abs(a.mean() - b.mean()), .01 * b.mean() + chance);
  EXPECT_LT(chance, .04 * b.mean()) << "would not see an error of 5%";
}

// One box in another: a ray splits at every hit, into a diffuse and two rough paths, and the boxes reflect
// what gets between them to and fro. However many there are, each ray of a gather has a bounded number of
// others.
TEST(RayWeights, WorkBetweenFiveBoxesHasABound) {
  RayOptions o = interpolated(2, 16, {-10, 1e-4});
  o.leastForPatches = 64;
  std::string boxes =
      "void light l 0 0 3 100 100 100\nl sphere lamp 0 0 4 0 0 0 .05\n"
      "void trans rough 0 0 7 .8 .8 .8 .1 .1 .6 .4\n";
  const V3d to = V3d(-.98, .05, .1).normalized();
  double ofFirst = 0;
  for (int count = 1; count <= 5; ++count) {
    boxes += boxOf("rough", .2 + .05 * count);
    Traced nested(boxes, o);
    int seen = 0;
    const RayObserver counting = [&](const RayEnd&, const RayResult&) { ++seen; };
    PathRequest request;
    request.observer = &counting;
    nested.tracerWith({}, {FirstBounce::fromPatches, true, true}).trace(V3d(1, 0, 0), to, 0, 1, request);
    // Shadow rays through a box are shown as well, one for each hit.
    EXPECT_LT(seen, 2 * (1 + count) * tuning::RayLimits::kMostDescendants * 16) << count;
    const CoarseSolution::Work work = nested.transport().caches().coarse->work();
    ASSERT_GT(work.patches, 10U) << count;
    const double ofPatch = static_cast<double>(work.rays) / static_cast<double>(work.patches);
    if (count == 1) ofFirst = ofPatch;
    EXPECT_LT(ofPatch, 2 * ofFirst) << count;
  }
}

// The same for a gather in the middle of 2 to 8 boxes, also of materials that lose little light. However
// many there are, each ray of the gather has on average at most twice as many descendants as the number at
// which roulette begins. Without roulette, the number of descendants grows exponentially.
TEST(RayWeights, WorkOfAGathersRayIsConstantInNestedBoxes) {
  constexpr int kRays = 64;
  const std::string lampAndPlate =
      "void light l 0 0 3 100 100 100\nl sphere lamp 0 0 4 0 0 0 .05\n"
      "void plastic white 0 0 5 .8 .8 .8 0 0\nwhite ring plate 0 0 8 0 0 .1 0 0 1 0 .05\n";
  for (const std::string material :
       {"void trans rough 0 0 7 .8 .8 .8 .1 .1 .6 .4\n", "void trans rough 0 0 7 .9 .9 .9 .5 .2 .9 .8\n",
        "void metal rough 0 0 5 .9 .9 .9 .9 .1\n"}) {
    std::string boxes = lampAndPlate + material;
    for (int count = 1; count <= 8; ++count) {
      boxes += boxOf("rough", .2 + .05 * count);
      if (count % 2 != 0) continue;
      Traced nested(boxes, interpolated(1, kRays, {-10, 1e-4}));
      int roots = 0, seen = 0;
      const RayObserver counting = [&](const RayEnd& end, const RayResult&) {
        if (end.context.ambientLevel != 1 || (end.context.kinds & kShadow)) return;
        ++seen;
        if (end.context.kind & kAmbient) ++roots;
      };
      PathRequest request;
      request.observer = &counting;
      PathTracer tracer = nested.tracerWith({}, {FirstBounce::gathered, true, false});
      tracer.trace(V3d(0, 0, .15), V3d(0, 0, -1), 0, 1, request);
      EXPECT_EQ(roots, kRays) << material << count;
      EXPECT_GT(seen, 4 * roots) << material << count;
      EXPECT_LT(seen, 2 * tuning::RayLimits::kMostDescendants * roots) << material << count;
    }
  }
}

// Pictures of a furnished office with six bounces took 87 s, because patches that others see were as small as
// those that gathers see.
TEST(RayWeights, PatchesThatOthersSeeMayBeWider) {
  std::string room = kSunlitRoom;
  for (int i = 0; i < 6; ++i)
    room += fmt::format("white polygon board{0} 0 0 12 1 {1} .3 3 {1} .3 3 {1} 1.5 1 {1} 1.5\n", i,
                        i * .4 + 1.05);
  double means[2] = {}, patches[2] = {};
  for (const int coarser : {0, 2}) {
    RayOptions o = interpolated(4, 16, {-4, 1e-4});
    o.leastForPatches = 256;
    o.coarserLinks = coarser;
    Traced traced(room, o);
    PathTracer tracer = traced.tracerWith({}, {FirstBounce::gathered});
    Sample sample;
    for (uint64_t i = 0; i < 400; ++i) {
      Random random(mixBits(i));
      const double z = 2 * random.uniform() - 1, around = 2 * std::numbers::pi * random.uniform();
      const V3d to(std::sqrt(1 - z * z) * std::cos(around), std::sqrt(1 - z * z) * std::sin(around), z);
      sample.add(tracer.trace(V3d(2.1, 2.05, 2), to, 0, mixBits(400 + i)).value.color.x);
    }
    means[coarser / 2] = sample.mean();
    patches[coarser / 2] = static_cast<double>(traced.transport().caches().coarse->work().patches);
  }
  EXPECT_NEAR(means[1], means[0], .01 * means[0]);
  EXPECT_LT(patches[1], .9 * patches[0]);
}

// A glimpse, which looks for openings, splits at every pane in a row. Without a bound, those of ten panes
// would take hours. These panes absorb nothing, so that the sky of radiance 1 is seen in all of them.
TEST(RayWeights, GlimpsesThroughPanesInARowHaveABoundAndTheSameMean) {
  std::string panes =
      "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n"
      "void BRTDfunc pane 10 .05 .05 .05 .95 .95 .95 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0\n";
  for (int i = 1; i <= 10; ++i) panes += fmt::format("pane ring pane{0} 0 0 8 0 0 {0} 0 0 1 0 50\n", i);
  RayOptions o = unbiased(0);
  o.reflectionLimit = 0;
  o.weightLimit = 1e-9;
  Traced row(panes, o);
  PathTracer tracer = row.tracerWith({});
  Sample sample;
  for (uint64_t i = 0; i < 2000; ++i)
    sample.add(tracer.glimpse(V3d(0, 0, 0), V3d(0, 0, 1), mixBits(i)).color.x);
  expectMean(sample, 1, 1.2);
}

// Paths within a closed cylinder of matte plastic gather at each surface.
TEST(RayWeights, WorkWithinAClosedCylinderOfMattePlasticHasABound) {
  RayOptions o = unbiased(6);
  o.ambientDivisions = 4;
  o.reflectionLimit = -10;
  o.weightLimit = 1e-5;
  Traced column(
      "void light l 0 0 3 100 100 100\nl sphere lamp 0 0 4 0 0 4 .2\nvoid plastic matte 0 0 5 .8 .8 .8 0 0\n"
      "matte cylinder column 0 0 7 0 0 0 0 0 1 .2\nmatte ring floor 0 0 8 0 0 0 0 0 1 0 .2\n"
      "matte ring ceiling 0 0 8 0 0 1 0 0 -1 0 .2\n",
      o);
  PathTracer tracer = column.tracerWith({}, {.boundsWork = true});
  for (uint64_t i = 0; i < 20; ++i) {
    size_t rays = 0;
    const RayObserver count = [&](const RayEnd&, const RayResult&) { ++rays; };
    EXPECT_EQ(tracer.trace(V3d(.03, .02, .3), V3d(.6, .3, .4).normalized(), 0, i, {.observer = &count})
                  .value.color.x,
              0);
    EXPECT_LT(rays, 50u);
  }
}

}  // namespace
}  // namespace rsphere
