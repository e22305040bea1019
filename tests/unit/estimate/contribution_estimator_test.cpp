#include "estimate/contribution_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

const std::string kRoomWithALampToo =
    kRoomWithAWindow +
    "void light shine 0 0 3 2 2 2\nshine polygon lamp 0 0 12 1 2 2.6 1 3 2.6 2 3 2.6 2 2 2.6\n";

RayOptions raysOfBins(int divisions) {
  RayOptions o = unbiased(2);
  o.ambientDivisions = divisions;
  o.weightLimit = 1e-4;
  return o;
}

// The sky in zones, and the lamp.
std::vector<TrackedModifier> skyAndLamp() {
  return {{"sky", 16, std::nullopt, std::make_shared<const EqualZones>(16)}, {"shine", 1, std::nullopt}};
}

// The green channel of each column at a sensor (-I), over many seeds.
struct Bins {
  std::map<uint32_t, Sample> values, variances;
  Sample sum, sumVariance, sumError;

  // Of the columns with at least a hundredth of the sum: true over stated errors, root mean squares.
  double trueOverStated() const {
    double off = 0, stated = 0;
    for (const auto& [column, sample] : values) {
      if (sample.mean() < .01 * sum.mean()) continue;
      off += sample.variance() / (sample.mean() * sample.mean());
      stated += variances.at(column).mean() / (sample.mean() * sample.mean());
    }
    return std::sqrt(off / stated);
  }
};

Bins repeatBins(int divisions, const RayEstimator::Options& how, uint64_t seeds) {
  Traced room(kRoomWithALampToo, raysOfBins(divisions), IrradianceAt::point);
  const Tracked tracked(room.prepared(), skyAndLamp(), Contributed::values);
  const ContributionEstimator estimator(room.transport(), how, Contributed::values);
  ContributionTracer tracer(room.transport().pathTracer(), tracked);
  Bins found;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto estimate = estimator.estimate(tracer, V3d(1.5, 1.2, .8001), V3d(0, 0, -1), 0, mixBits(seed));
    double sum = 0;
    std::map<uint32_t, size_t> at;
    for (size_t i = 0; i < estimate.means.columns().size(); ++i) at[estimate.means.columns()[i]] = 3 * i + 1;
    for (uint32_t column = 0; column < tracked.columns(); ++column) {
      const bool has = at.contains(column);
      const double value = has ? estimate.means.values()[at[column]] : 0;
      sum += value;
      found.values[column].add(value);
      found.variances[column].add(has ? estimate.variances[at[column]] : 0);
    }
    EXPECT_NEAR(sum, estimate.sum.ray.value.color.y, 1e-9 * sum);
    found.sum.add(sum);
    found.sumVariance.add(estimate.sum.brightnessError * estimate.sum.brightnessError);
    found.sumError.add(estimate.sum.relativeError);
  }
  return found;
}

bool binsAreHonest(double trueOverStated) { return trueOverStated > .8 && trueOverStated < 1.25; }

TEST(ContributionEstimator, StatesTheSpreadOfEachBin) {
  const Bins found = repeatBins(512, {}, 100);
  EXPECT_TRUE(binsAreHonest(found.trueOverStated())) << found.trueOverStated();
  EXPECT_FALSE(binsAreHonest(1.6 * found.trueOverStated())) << "errors that are stated 1.6 times too small";
  const double ofSum = std::sqrt(found.sum.variance() / found.sumVariance.mean());
  EXPECT_TRUE(binsAreHonest(ofSum)) << ofSum;
}

TEST(ContributionEstimator, TheSumReachesTheAccuracy) {
  const Bins found = repeatBins(64, {.accuracy = .01}, 60);
  const double off = std::sqrt(found.sum.variance()) / found.sum.mean();
  EXPECT_LT(off, 1.15 * .01);
  EXPECT_GT(off, .3 * .01) << "it takes more rays than the accuracy asks for";
  EXPECT_LE(found.sumError.mean(), .01);
  EXPECT_TRUE(binsAreHonest(found.trueOverStated())) << found.trueOverStated();
}

// The value is that of as many rays without errors.
TEST(ContributionEstimator, HasTheMeanOfPlainRays) {
  const Bins found = repeatBins(256, {}, 200);
  Traced room(kRoomWithALampToo, raysOfBins(256), IrradianceAt::point);
  const Tracked tracked(room.prepared(), skyAndLamp(), Contributed::values);
  ContributionTracer tracer(room.transport().pathTracer(), tracked);
  Sample plain;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    double sum = 0;
    const ContributionList& list = tracer.trace(V3d(1.5, 1.2, .8001), V3d(0, 0, -1), 0, mixBits(seed));
    for (size_t i = 0; i < list.columns().size(); ++i) sum += list.values()[3 * i + 1];
    plain.add(sum);
  }
  const double error = std::sqrt((plain.variance() + found.sum.variance()) / 200);
  EXPECT_NEAR(found.sum.mean(), plain.mean(), 4 * error);
  EXPECT_LT(error, .003 * plain.mean());
}

}  // namespace
}  // namespace rsphere
