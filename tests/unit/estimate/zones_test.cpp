// Zones of directions (-Sz): their mean radiances and standard errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "estimate/estimator.h"
#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "scene/contributors.h"
#include "tests/unit/support/sphere_setting.h"

namespace rsphere {
namespace {

constexpr int kZones = 24;

const std::string kRoomOfZones =
    "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 9 8 7\nvoid light lamp2 0 0 3 3 3 3\n"
    "void plastic goal 0 0 5 .5 .4 .3 0 0\nvoid mirror silver 0 0 3 .8 .8 .8\n"
    "wall polygon f 0 0 12 0 0 0 5 0 0 5 4 0 0 4 0\nwall polygon c 0 0 12 0 0 3 0 4 3 5 4 3 5 0 3\n"
    "wall polygon s 0 0 12 0 0 0 0 0 3 5 0 3 5 0 0\nwall polygon n 0 0 12 0 4 0 5 4 0 5 4 3 0 4 3\n"
    "wall polygon w 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\nwall polygon e 0 0 12 5 0 0 5 0 3 5 4 3 5 4 0\n"
    "goal polygon t 0 0 12 1 1 .7 2 1 .7 2 2 .7 1 2 .7\nsilver sphere b 0 0 4 3.5 1 1.5 .2\n";
const std::string kLamps =
    "lamp polygon p 0 0 12 2 2 2.9 2 2.5 2.9 3 2.5 2.9 3 2 2.9\nlamp2 sphere q 0 0 4 4 3 2 .1\n";
// Not known to paths from both ends.
const std::string kCrystal =
    "void dielectric crystal 0 0 5 .9 .9 .9 1.5 0\ncrystal sphere d 0 0 4 2 3 1 .3\n";

struct Case {
  const char* name;
  std::string text;
  std::vector<std::string> goals;
  Weights weights = Weights::silhouettes;
  double accuracy = 0;
};
std::vector<Case> cases() {
  return {{"lamps", kRoomOfZones + kLamps, {}},
          {"a goal", kRoomOfZones, {"goal"}},
          {"a goal and a crystal", kRoomOfZones + kCrystal, {"goal"}},
          {"lamps and a crystal", kRoomOfZones + kCrystal + kLamps, {}},
          {"an accuracy", kRoomOfZones, {"goal"}, Weights::silhouettes, .01},
          {"equal weights", kRoomOfZones + kLamps, {}, Weights::homogeneous},
          {"cells", kRoomOfZones + kLamps, {}, Weights::voronoi}};
}

class Answers {
 public:
  explicit Answers(const Case& how, bool separate = false)
      : how_(how), setting_(sceneOf(how, separate), [](RayOptions& o) { o.ambientBounces = 2; }) {}

  // bins: instead of zones.
  PointAnswer at(uint64_t rotation, int zones = kZones, int directions = 512,
                 const std::shared_ptr<const DirectionBins>& bins = {}) const {
    SphereOptions o = setting_.options.sphere;
    o.weights = how_.weights;
    o.baseDirections = directions;
    o.mostDirections = 2 * directions;
    o.accuracy = how_.accuracy;
    o.mostForAccuracy = 20000;
    o.rotation = rotation;
    o.zones = zones;
    o.bins = bins;
    const SphereEstimator estimator(*setting_.transport, o, true);
    SphereEstimator::Workspace workspace(estimator);
    return estimator.estimate(V3d(2.6, 1.6, 1.4), workspace);
  }

 private:
  static Scene sceneOf(const Case& how, bool separate) {
    Scene scene = buildScene(rad::readSceneText(how.text, "room.rad"), {}, how.goals);
    if (separate) separateContributors(scene, how.goals);
    return scene;
  }
  Case how_;
  SphereSetting setting_;
};

TEST(Zones, AverageToTheMean) {
  for (const Case& how : cases()) {
    SCOPED_TRACE(how.name);
    const Answers answers(how);
    const PointAnswer divided = answers.at(1), whole = answers.at(1, 0);
    ASSERT_EQ(divided.zones.size(), static_cast<size_t>(kZones));
    EXPECT_TRUE(whole.zones.empty());
    Radiance sum;
    for (const Radiance& zone : divided.zones) sum += zone / kZones;
    EXPECT_NEAR(brightness(sum), brightness(divided.mean), 1e-12 * brightness(divided.mean));
    EXPECT_NEAR(brightness(whole.mean), brightness(divided.mean), 1e-12 * brightness(divided.mean));
    EXPECT_NEAR(whole.brightnessError, divided.brightnessError, 1e-9 * whole.brightnessError);
  }
}

// Slices of different width by height, the lowest in no bin.
std::shared_ptr<const DirectionBins> slices() {
  return std::make_shared<const DirectionBins>(3, [](const V3d& d) {
    return d.z < -.6 ? 9 : d.z < -.2 ? 2 : d.z < .5 ? 1 : size_t{0};
  });
}

TEST(Zones, OfAFunctionAddUpToTheMean) {
  const auto bins = slices();
  const auto all = std::make_shared<const DirectionBins>(
      4, [&](const V3d& d) { return std::min(bins->binAt(d), size_t{3}); });
  for (const Case& how : cases()) {
    SCOPED_TRACE(how.name);
    const Answers answers(how);
    const PointAnswer whole = answers.at(1, 0), divided = answers.at(1, 4, 512, all),
                      part = answers.at(1, 3, 512, bins);
    ASSERT_EQ(divided.zones.size(), 4);
    double sum = 0;
    for (size_t i = 0; i < 4; ++i)
      sum += brightness(divided.zones[i]) * all->solidAngle(i) / (4 * std::numbers::pi);
    EXPECT_NEAR(sum, brightness(whole.mean), 1e-12 * sum);
    ASSERT_EQ(part.zones.size(), 3);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(brightness(part.zones[i]), brightness(divided.zones[i]), 1e-12 * sum);
      EXPECT_NEAR(part.zoneErrors[i].brightness, divided.zoneErrors[i].brightness, 1e-9 * sum);
    }
    EXPECT_NEAR(part.brightnessError, whole.brightnessError, 1e-9 * whole.brightnessError);
  }
}

TEST(Zones, HavePartsOfContributors) {
  const Answers plain(cases()[0]), divided(cases()[0], true);
  const PointAnswer a = plain.at(1), b = divided.at(1);
  for (size_t i = 0; i < kZones; ++i) {
    const Color sum = b.zones[i].color.part(0) + b.zones[i].color.part(1);
    EXPECT_NEAR(brightness(sum), brightness(a.zones[i]), 1e-12 * brightness(a.mean));
    EXPECT_GT(brightness(b.zoneErrors[i].channels.color.part(1)), 0);
  }
}

// The root of the mean over many repeats, of the squares of deviations over those that are stated.
double trueOverStated(const Answers& answers, int zones = kZones,
                      const std::shared_ptr<const DirectionBins>& bins = {}) {
  constexpr int kRepeats = 8;
  std::vector<PointAnswer> all;
  for (uint64_t r = 0; r < kRepeats; ++r) all.push_back(answers.at(r + 1, zones, 512, bins));
  double squares = 0, stated = 0;
  for (size_t i = 0; i < all[0].zones.size(); ++i) {
    double mean = 0;
    for (const PointAnswer& a : all) mean += brightness(a.zones[i]) / kRepeats;
    for (const PointAnswer& a : all) {
      squares += std::pow(brightness(a.zones[i]) - mean, 2) / (kRepeats - 1);
      stated += std::pow(a.zoneErrors[i].brightness, 2) / kRepeats;
    }
  }
  return std::sqrt(squares / stated);
}

// Within a factor of 2 or 4, on average over all zones. Errors that are eight times as small or as large are
// rejected.
bool isHonest(double found) { return found > .25 && found < 2; }
void expectHonest(double found) {
  EXPECT_TRUE(isHonest(found)) << found;
  EXPECT_FALSE(isHonest(8 * found)) << found;
  EXPECT_FALSE(isHonest(found / 8)) << found;
}

TEST(Zones, StateTheirErrors) {
  for (const Case& how : cases()) {
    SCOPED_TRACE(how.name);
    expectHonest(trueOverStated(Answers(how)));
  }
}

TEST(Zones, OfAFunctionStateTheirErrors) { expectHonest(trueOverStated(Answers(cases()[1]), 3, slices())); }

// In a furnace the radiance is 1 in all directions, so that deviations are those of cells at borders.
TEST(Zones, OfAFurnaceAreAllAlike) {
  const Case furnace{"furnace",
                     "void plastic half 0 0 5 .5 .5 .5 0 0\nvoid glow even 0 0 4 1 1 1 0\n"
                     "even bubble b 0 0 4 0 0 0 9\n",
                     {}};
  const Answers answers(furnace);
  double worst = 0;
  for (const uint64_t rotation : {1, 2, 3}) {
    const PointAnswer a = answers.at(rotation, 60, 2048);
    for (size_t i = 0; i < a.zones.size(); ++i) {
      EXPECT_NEAR(brightness(a.zones[i]), 1, 6 * a.zoneErrors[i].brightness);
      EXPECT_LT(a.zoneErrors[i].brightness, .04);
      worst = std::max(worst, std::abs(brightness(a.zones[i]) - 1));
    }
  }
  EXPECT_GT(worst, 1e-4);  // so that the first comparison says something
}

}  // namespace
}  // namespace rsphere
