#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "base/constants.h"
#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "sphere/directions.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::glances_test {
namespace {

struct Setting : SphereSetting {
  explicit Setting(const std::string& text, int bounces = 0, bool goal = false)
      : SphereSetting(
            [&] {
              const std::string goals[] = {"goal"};
              return buildScene(rad::readSceneText(text, "room.rad"), {},
                                goal ? std::span<const std::string>(goals) : std::span<const std::string>());
            }(),
            [&](RayOptions& o) {
              o.ambientBounces = bounces;
              o.sourceSubstructuring = .05;
            }) {}
};

constexpr const char* kMaterials =
    "void plastic gray 0 0 5 .6 .5 .4 0 0\nvoid metal steel 0 0 5 .6 .6 .6 .5 .1\nvoid mirror silver 0 0 3 "
    ".9 .9 .9\nvoid light lamp 0 0 3 20 20 20\nvoid plastic goal 0 0 5 .4 .25 .15 0 0\n";

// A desk that is the goal, with a partition beside it.
std::string deskBesideGoal() {
  std::string text = kMaterials;
  const auto wall = [&](const char* p) { text += fmt::format("gray polygon w 0 0 12 {}\n", p); };
  wall("0 0 0 6 0 0 6 5 0 0 5 0");
  wall("0 5 3 6 5 3 6 0 3 0 0 3");
  wall("0 0 0 0 0 3 6 0 3 6 0 0");
  wall("6 0 0 6 0 3 6 5 3 6 5 0");
  wall("6 5 0 6 5 3 0 5 3 0 5 0");
  wall("0 5 0 0 5 3 0 0 3 0 0 0");
  wall("1.9 2.34 0 1.9 2.34 1.4 3.7 2.34 1.4 3.7 2.34 0");
  return text + "goal polygon top 0 0 12 2 1.5 .74 3.6 1.5 .74 3.6 2.3 .74 2 2.3 .74\n";
}

struct Spread {
  Sample mean;
  size_t directions = 0;
  double relative(int rotations) const {
    return mean.standardError() * std::sqrt(static_cast<double>(rotations)) / mean.mean();
  }
};
Spread spreadOf(const Setting& setting, double density, int base, int rotations) {
  Spread spread;
  SphereOptions o = setting.options.sphere;
  o.baseDirections = base;
  o.mostDirections = 2 * base;
  o.densityFactor = density;
  o.everyDirection = true;  // so that the directions add up to the mean
  for (int k = 1; k <= rotations; ++k) {
    o.rotation = static_cast<uint64_t>(k);
    const SphereEstimator estimator(*setting.transport, o);
    SphereEstimator::Workspace workspace(estimator);
    const PointAnswer a = estimator.estimate(V3d(2.8, 1.2, 1.2), workspace);
    spread.mean.add(brightness(a.mean));
    spread.directions = a.directions;
    double sum = 0;
    for (const DirectionSample& s : workspace.samples) {
      sum += s.solidAngle * brightness(s.value);
      EXPECT_GE(std::min({s.value.color.x, s.value.color.y, s.value.color.z}), 0)
          << "the share of glances leaves no radiance negative";
    }
    EXPECT_NEAR(sum / (4 * kPi), brightness(a.mean), 1e-9 * brightness(a.mean));
  }
  return spread;
}

// With -Sk 0 there are no glances, and nothing gets directions of its own.
TEST(Glances, HalveTheErrorBesideAGoalWithoutBias) {
  for (const int bounces : {0, 3}) {
    const Setting setting(deskBesideGoal(), bounces, true);
    const Spread ours = spreadOf(setting, 1, 300, 30), equal = spreadOf(setting, 0, 400, 30);
    EXPECT_LE(ours.directions, equal.directions);
    EXPECT_LT(2 * ours.relative(30), equal.relative(30)) << bounces;
    const double error = std::hypot(ours.mean.standardError(), equal.mean.standardError());
    EXPECT_LT(std::abs(ours.mean.mean() - equal.mean.mean()), 3 * error) << bounces;
    EXPECT_GT(std::abs(1.01 * ours.mean.mean() - equal.mean.mean()), 3 * error)
        << "would not see an error of 1%";
  }
}

// By lamps, in a room with a sheet that paths from both ends do not know.
TEST(Glances, LeaveTheMeanByLampsAsItIs) {
  const Setting setting(deskBesideGoal() +
                        "lamp polygon l 0 0 12 3 3 2.9 3 4 2.9 5 4 2.9 5 3 2.9\n"
                        "void trans paper 0 0 7 .6 .6 .6 0 0 .3 0\n"
                        "paper polygon sheet 0 0 12 1 4 1 1.3 4 1 1.3 4 1.3 1 4 1.3\n");
  const Spread ours = spreadOf(setting, 1, 300, 60), equal = spreadOf(setting, 0, 300, 60);
  const double error = std::hypot(ours.mean.standardError(), equal.mean.standardError());
  EXPECT_LT(std::abs(ours.mean.mean() - equal.mean.mean()), 3 * error);
  EXPECT_GT(std::abs(1.02 * ours.mean.mean() - equal.mean.mean()), 3 * error)
      << "would not see an error of 2%";
}

// Half of the source is hidden, at a slant: shadow rays tell how much, few directions as they are.
TEST(SeenSources, HowMuchIsHiddenByShadowRays) {
  const Setting setting(std::string(kMaterials) +
                        "lamp polygon l 0 0 12 -1 -1 3 -1 1 3 1 1 3 1 -1 3\n"
                        "gray polygon o 0 0 9 -3 -1.3 1.5 3 1.7 1.5 -3 9 1.5\n");
  Sample mean;
  SphereOptions o = setting.options.sphere;
  o.baseDirections = 64;
  o.mostDirections = 128;
  for (uint64_t k = 1; k <= 60; ++k) {
    o.rotation = k;
    const SphereEstimator estimator(*setting.transport, o);
    SphereEstimator::Workspace workspace(estimator);
    double seen = 0;
    estimator.estimate(V3d(0, 0, 0), workspace);
    for (const DirectionSample& s : workspace.samples) seen += s.toSource ? s.solidAngle : 0;
    mean.add(seen);
  }
  // The occluder's edge as it is seen on the lamp, twice as far.
  const auto edge = [](double x) { return 2 * (-1.3 + .5 * (x / 2 + 3)); };
  const V3d visible[] = {V3d(-1, -1, 3), V3d(1, -1, 3), V3d(1, edge(1), 3), V3d(-1, edge(-1), 3)};
  const double exact = polygonSolidAngle(visible, V3d(0, 0, 0));
  EXPECT_NEAR(mean.mean() / exact, 1, 3 * mean.standardError() / exact);
  EXPECT_LT(mean.standardError() * std::sqrt(60.) / exact, .03) << "one direction a part: .05";
}

}  // namespace
}  // namespace rsphere::glances_test
