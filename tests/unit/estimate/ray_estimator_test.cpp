#include "estimate/ray_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// A furnished room of 4 x 4 x 3 with a luminaire; the table hides it from the second sensor.
const std::string kRoomWithALamp =
    "void plastic white 0 0 5 .6 .6 .6 0 0\nvoid light shine 0 0 3 30 30 30\n" +
    roomOf("white", V3d(4, 4, 3)) +
    "shine polygon lamp 0 0 12 1 1 2.9 1 1.4 2.9 2.2 1.4 2.9 2.2 1 2.9\n"
    "white polygon table 0 0 12 .5 .5 .8 2.5 .5 .8 2.5 2 .8 .5 2 .8\n";

// Sensors (-I): as on the command line, a ray comes down to each from a little above.
const V3d kSensors[] = {V3d(2, 3, .9001), V3d(1.5, 1.2, .4001)};
const V3d kDown(0, 0, -1);

RayOptions raysOf(double ambientAccuracy, int solutions = static_cast<int>(RayEstimator::kSolutions)) {
  RayOptions o = unbiased(3);
  o.ambientAccuracy = ambientAccuracy;
  o.ambientDivisions = 256;
  o.sourceSubstructuring = .05;
  o.weightLimit = 1e-4;
  o.solutions = ambientAccuracy > 0 ? solutions : 1;
  return o;
}

struct Repeats {
  double off = 0, stated = 0;  // root mean squares, relative
  double beyondFour = 0;       // fraction of the answers
  double largestStated = 0, reached = 0;

  double trueOverStated() const { return off / stated; }
};

// Repeats with different random numbers, also of the patches. With one sensor out of two unlit by the lamp,
// errors are relative to each sensor's mean.
Repeats repeat(const std::string& text, RayOptions options, const RayEstimator::Options& how,
               uint64_t seeds) {
  const Scene scene = sceneOf(text);
  std::vector<std::vector<RayEstimator::Estimate>> all(std::size(kSensors));
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    options.rotation = seed;
    const Transport transport(scene, options, IrradianceAt::point);
    const RayEstimator estimator(transport, how);
    auto tracers = estimator.tracers();
    for (size_t i = 0; i < all.size(); ++i)
      all[i].push_back(estimator.estimate(tracers, kSensors[i], kDown, 0, mixBits(seed)));
  }
  Repeats found;
  double count = 0;
  for (const auto& estimates : all) {
    Sample values;
    for (const auto& e : estimates) values.add(brightness(e.ray.value));
    for (const auto& e : estimates) {
      const double off = brightness(e.ray.value) / values.mean() - 1,
                   error = e.brightnessError / values.mean();
      found.off += off * off * static_cast<double>(seeds) / static_cast<double>(seeds - 1);
      found.stated += error * error;
      found.beyondFour += std::abs(off) > 4 * error;
      found.reached += e.reached;
      found.largestStated = std::max(found.largestStated, e.relativeError);
      ++count;
    }
  }
  found.off = std::sqrt(found.off / count);
  found.stated = std::sqrt(found.stated / count);
  found.beyondFour /= count;
  found.reached /= count;
  return found;
}

bool areHonest(double trueOverStated) { return trueOverStated > .8 && trueOverStated < 1.25; }

TEST(RayEstimator, StatesTheSpreadOfItsAnswers) {
  for (const std::string& room : {kRoomWithALamp, kRoomWithAWindow}) {
    for (const double accuracy : {0., .1}) {
      RayOptions options = raysOf(accuracy);
      options.ambientDivisions = 1024;
      const Repeats found = repeat(room, options, {}, 30);
      EXPECT_TRUE(areHonest(found.trueOverStated())) << found.trueOverStated() << " with -aa " << accuracy;
      EXPECT_LE(found.beyondFour, .02);
      EXPECT_FALSE(areHonest(1.6 * found.trueOverStated())) << "an error that is stated 1.6 times too small";
    }
  }
}

// The spoiled twin: if all sets use one solution, the noise of its patches does not show in their spread. So
// that it is the larger part of the noise, a patch gets few rays, and the gather many.
TEST(RayEstimator, NoiseOfPatchesIsInItsErrors) {
  RayOptions own = raysOf(.1), common = raysOf(.1, 1);
  const RayEstimator::Options accurate{.accuracy = .01};
  const Repeats several = repeat(kRoomWithALamp, own, accurate, 20),
                one = repeat(kRoomWithALamp, common, accurate, 20);
  EXPECT_TRUE(areHonest(several.trueOverStated())) << several.trueOverStated();
  EXPECT_GT(one.trueOverStated(), 1.25);
}

TEST(RayEstimator, ReachesTheAccuracy) {
  for (const std::string& room : {kRoomWithALamp, kRoomWithAWindow}) {
    const Repeats found = repeat(room, raysOf(0), {.accuracy = .02}, 100);
    EXPECT_LT(found.off, 1.1 * .02);
    EXPECT_GT(found.off, .3 * .02) << "it takes more rays than the accuracy asks for";
    EXPECT_TRUE(areHonest(found.trueOverStated())) << found.trueOverStated();
    EXPECT_EQ(found.reached, 1);
    EXPECT_LE(found.largestStated, .02);
  }
}

// The noise of patches with few rays is not reduced by more rays of the sensors, which paths answer instead.
// With patches alone, half of these answers reach the accuracy, and their error is .56%.
TEST(RayEstimator, PatchesThatAreTooNoisyAreNotUsed) {
  RayOptions options = raysOf(.1);
  options.raysForPatches = 8;
  const Repeats found = repeat(kRoomWithALamp, options, {.accuracy = .003}, 12);
  EXPECT_LT(found.off, 1.3 * .003);
  EXPECT_GE(found.reached, .8);
}

// Solutions of a half may agree by chance. By the spread in each half, this error would be 0.
TEST(RayEstimator, HalvesThatDifferHaveAnError) {
  const Scene scene = sceneOf(kRoomWithALamp);
  const Transport transport(scene, raysOf(.2), IrradianceAt::point);
  const RayEstimator estimator(transport, {.accuracy = .01});
  const auto gather = [](const RayEstimator::Sent& sent) {
    TracedRay ray;
    ray.value = Radiance(Color(sent.set < RayEstimator::kSets / 2 ? 1 : 1.2));
    return ray;
  };
  const RayEstimator::Estimate estimate = estimator.estimate(gather, 1);
  EXPECT_NEAR(brightness(estimate.ray.value), 1.1, 1e-9);
  EXPECT_NEAR(estimate.brightnessError, .1 / std::sqrt(7.), 1e-6);  // of eight values 1.1 +- .1
}

// Gathers that are interleaved belong to different sets of one half, and have equal numbers of rays.
TEST(RayEstimator, SetsShareLattices) {
  const Scene scene = sceneOf(kRoomWithALamp);
  const Transport transport(scene, raysOf(.1), IrradianceAt::point);
  const RayEstimator estimator(transport, {});
  std::map<uint64_t, std::vector<RayEstimator::Sent>> lattices;
  const auto gather = [&](const RayEstimator::Sent& sent) {
    lattices[sent.together].push_back(sent);
    return TracedRay();
  };
  estimator.estimate(gather, 1);
  EXPECT_GE(lattices.size(), 2 * RayEstimator::kSets / kInterleavedGathers) << "two gathers of each set";
  for (const auto& [lattice, gathers] : lattices) {
    ASSERT_EQ(gathers.size(), kInterleavedGathers);
    for (size_t k = 0; k < gathers.size(); ++k) {
      EXPECT_EQ(gathers[k].set % kInterleavedGathers, k);
      EXPECT_EQ(gathers[k].set / kInterleavedGathers, gathers[0].set / kInterleavedGathers);
      EXPECT_EQ(gathers[k].rays, gathers[0].rays);
    }
  }
}

// A sensor in a closed box of the scene would take as many rays as are allowed.
TEST(RayEstimator, ADarkSensorNeedsOnlyTheFloor) {
  const Repeats to = repeat(kRoomWithALamp, raysOf(0), {.accuracy = .01, .floor = 1e6}, 2);
  EXPECT_GT(to.stated, .012) << "one round of sets";
  EXPECT_EQ(to.reached, 1);
}

TEST(RayEstimator, StoppingLeavesNoBias) {
  const Scene scene = sceneOf(kRoomWithAWindow);
  Sample stopped, plain;
  const Transport transport(scene, raysOf(0), IrradianceAt::point);
  const RayEstimator estimator(transport, {.accuracy = .2, .floor = 0});
  auto tracers = estimator.tracers();
  PathTracer tracer = transport.pathTracer();
  for (uint64_t seed = 1; seed <= 1500; ++seed) {
    stopped.add(brightness(estimator.estimate(tracers, kSensors[0], kDown, 0, mixBits(seed)).ray.value));
    plain.add(brightness(tracer.trace(kSensors[0], kDown, 0, mixBits(seed)).value));
  }
  const double error = std::hypot(stopped.standardError(), plain.standardError());
  EXPECT_LT(std::abs(stopped.mean() - plain.mean()), kMostSigmas * error);
  EXPECT_LT(kMostSigmas * error, .03 * plain.mean()) << "too few seeds to see a bias of 3%";
}

// Without a limit on the bounces, noisy slopes of patches once made light grow from bounce to bounce, and so
// did Russian roulette that ended paths sooner than their light fell.
TEST(RayEstimator, AllBouncesByPatchesAreThoseOfPaths) {
  std::string room = kRoomWithALamp;
  room.replace(room.find(".6 .6 .6"), 8, ".8 .8 .8");
  const Scene scene = sceneOf(room);
  double found[2];
  for (const int k : {0, 1}) {
    RayOptions options = raysOf(k == 0 ? 0 : .1);
    options.ambientBounces = RayOptions::kAllBounces;
    options.reflectionLimit = -RayOptions::kAllBounces;
    const Transport transport(scene, options, IrradianceAt::point);
    const RayEstimator estimator(transport, {.accuracy = .01});
    auto tracers = estimator.tracers();
    found[k] = brightness(estimator.estimate(tracers, kSensors[1], kDown, 0, 1).ray.value);
  }
  EXPECT_NEAR(found[1] / found[0], 1, .06);
}

// A strip in a cove lights the ceiling near it more than the rest of the same patches. Without slopes in the
// light of patches that have few rays, sensors below were 7% too bright.
TEST(RayEstimator, PatchesBesideACoveAreNotTooBright) {
  const Scene scene =
      sceneOf("void plastic white 0 0 5 .6 .6 .6 0 0\nvoid light shine 0 0 3 1000 1000 1000\n" +
              roomOf("white", V3d(20, 2.4, 3)) +
              "white polygon shelf 0 0 12 0 0 2.7 20 0 2.7 20 .2 2.7 0 .2 2.7\n"
              "white polygon lip 0 0 12 0 .2 2.7 20 .2 2.7 20 .2 2.82 0 .2 2.82\n"
              "shine polygon strip 0 0 12 .2 .05 2.74 19.8 .05 2.74 19.8 .08 2.74 .2 .08 2.74\n");
  const V3d place(2, 1.2, .0101);
  const auto answers = [&](double ambientAccuracy, uint64_t seeds) {
    RayOptions options = raysOf(ambientAccuracy);
    options.ambientBounces = 2;
    Sample sample;
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
      options.rotation = seed;
      const Transport transport(scene, options, IrradianceAt::point);
      const RayEstimator estimator(transport, {.accuracy = .02});
      auto tracers = estimator.tracers();
      sample.add(brightness(estimator.estimate(tracers, place, kDown, 0, mixBits(seed)).ray.value));
    }
    return sample;
  };
  const Sample paths = answers(0, 12), patches = answers(.1, 24);
  const double error = std::hypot(patches.standardError(), paths.standardError()) / paths.mean();
  EXPECT_LT(error, .012);
  EXPECT_NEAR(patches.mean() / paths.mean(), 1, .035);
}

TEST(RayEstimator, AnswersDependOnTheSeedAlone) {
  const Scene scene = sceneOf(kRoomWithAWindow);
  const Transport transport(scene, raysOf(.1), IrradianceAt::point);
  const RayEstimator estimator(transport, {.accuracy = .05});
  auto used = estimator.tracers(), fresh = estimator.tracers();
  estimator.estimate(used, kSensors[1], kDown, 0, 7);
  const auto a = estimator.estimate(used, kSensors[0], kDown, 0, 3),
             b = estimator.estimate(fresh, kSensors[0], kDown, 0, 3);
  EXPECT_EQ(a.ray.value.color, b.ray.value.color);
  EXPECT_EQ(a.standardError.color, b.standardError.color);
}

// Rays of which nothing is random: all sets are equal.
TEST(RayEstimator, NoErrorWhereNothingIsRandom) {
  const Scene scene = sceneOf("void glow bright 0 0 4 2 2 2 0\nbright source sky 0 0 4 0 0 1 360\n");
  const Transport transport(scene, raysOf(0), IrradianceAt::none);
  const RayEstimator estimator(transport, {.accuracy = .01});
  auto tracers = estimator.tracers();
  const auto found = estimator.estimate(tracers, V3d(0, 0, 0), kDown, 0, 3);
  EXPECT_EQ(found.ray.value.color, Color(2, 2, 2));
  EXPECT_EQ(found.brightnessError, 0);
}

}  // namespace
}  // namespace rsphere
