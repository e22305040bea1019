// Light and importance are duals: what a lamp at a point sends to a surface is what the point sees of
// importance that the surface emits (Veach 1997, chapter 4). A lamp of intensity I in all directions puts E =
// I F / A on a goal of area A, where F = 4 pi v is the integral of importance at the lamp's place.
#include <gtest/gtest.h>

#include <string>

#include "base/constants.h"
#include "estimate/estimator.h"
#include "scene/build_scene.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

const V3d kLamp(1, 1.2, 1.9);
constexpr double kLampRadius = .01, kLampRadiance = 1000;
constexpr double kGoalHeight = .7, kGoalX = 2.2, kGoalY = 1.6, kGoalWidth = .8, kGoalDepth = .5;

// A room of 4 x 3 x 2.5 m, divided in part by a pane of glass.
const std::string kRoomWithPane = R"(
void plastic wall 0 0 5 .6 .5 .4 0 0
wall polygon floor 0 0 12 0 0 0 4 0 0 4 3 0 0 3 0
wall polygon ceiling 0 0 12 0 0 2.5 0 3 2.5 4 3 2.5 4 0 2.5
wall polygon south 0 0 12 0 0 0 0 0 2.5 4 0 2.5 4 0 0
wall polygon east 0 0 12 4 0 0 4 0 2.5 4 3 2.5 4 3 0
wall polygon north 0 0 12 4 3 0 4 3 2.5 0 3 2.5 0 3 0
wall polygon west 0 0 12 0 3 0 0 3 2.5 0 0 2.5 0 0 0
void glass pane 0 0 3 .9 .8 .7
pane polygon window 0 0 12 1.6 .2 .2 1.6 2 .2 1.6 2 2.2 1.6 .2 2.2
)";

// A room of 4 x 3 x 2.5 m with a pane of glass and a glass ball between the lamp and the goal, and a mirror
// on the wall behind the goal.
std::string room(bool lit) {
  std::string text = kRoomWithPane + R"(
void dielectric crystal 0 0 5 .9 .95 .98 1.5 0
crystal sphere ball 0 0 4 2.9 1.2 1.3 .15
void mirror silver 0 0 3 .9 .85 .8
silver polygon mirror 0 0 12 3.98 1 .75 3.98 1 2.2 3.98 2.6 2.2 3.98 2.6 .75
void plastic goal 0 0 5 .5 .35 .2 0 0
goal polygon top 0 0 12 2.2 1.6 .7 3 1.6 .7 3 2.1 .7 2.2 2.1 .7
)";
  if (lit) text += "void light lamp_mat 0 0 3 1000 1000 1000\nlamp_mat sphere lamp 0 0 4 1 1.2 1.9 .01\n";
  return text;
}

RayOptions finely(int bounces) {
  RayOptions o;
  o.ambientBounces = bounces;
  o.ambientAccuracy = 0;
  o.ambientDivisions = 4;
  o.ambientSuperSamples = 0;
  o.directThreshold = 0;
  o.directJitter = 1;
  o.sourceSubstructuring = .05;
  o.specularThreshold = 0;
  o.weightLimit = 1e-6;
  return o;
}

// Mean irradiance on the goal, by rays that start at its surface, with one bounce more than importance is
// traced with: the goal itself is the first.
Sample irradianceOnGoal(int bounces, int relays = 2, int side = 100) {
  const Scene scene = sceneOf(room(true));
  RayOptions options = finely(bounces + 1);
  options.directRelays = relays;
  const Transport transport(scene, options, IrradianceAt::point);
  PathTracer tracer = transport.pathTracer();
  Random random(7);
  Sample sample;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const V3d at(kGoalX + kGoalWidth * (i + random.uniform()) / side,
                   kGoalY + kGoalDepth * (j + random.uniform()) / side, kGoalHeight + 1e-4);
      sample.add(tracer.trace(at, V3d(0, 0, -1), 0, random.bits()).value.color.y);
    }
  return sample;
}

Sample irradianceByImportance(int bounces, bool basic, uint64_t rotations) {
  Scene scene = [] {
    const std::string goals[] = {"goal"};
    return buildScene(rad::readSceneText(room(false), "room.rad"), {}, goals);
  }();
  const Transport transport(scene, finely(bounces), IrradianceAt::none, basic);
  Sample sample;
  for (uint64_t rotation = 1; rotation <= rotations; ++rotation) {
    SphereOptions options;
    options.baseDirections = 1024;
    options.rotation = rotation;
    const SphereEstimator estimator(transport, options);
    SphereEstimator::Workspace workspace(estimator);
    const double intensity = kLampRadiance * kPi * kLampRadius * kLampRadius;
    sample.add(4 * kPi * intensity * estimator.estimate(kLamp, workspace).mean.color.y /
               (kGoalWidth * kGoalDepth));
  }
  return sample;
}

TEST(Duality, IrradianceFromALampIsWhatImportancePredicts) {
  const Sample light = irradianceOnGoal(2, 2, 180);
  const Sample importance = irradianceByImportance(2, false, 8);
  const double error = std::hypot(light.standardError(), importance.standardError());
  RecordProperty("light", std::to_string(light.standardError() / light.mean()));
  RecordProperty("importance", std::to_string(importance.standardError() / importance.mean()));
  RecordProperty("difference", std::to_string(importance.mean() / light.mean() - 1));
  // .5% is what the comparison has to see: both together must be surer than that.
  EXPECT_LT(3 * error, .005 * light.mean());
  EXPECT_LT(std::abs(light.mean() - importance.mean()), .005 * light.mean())
      << light.mean() << " +- " << light.standardError() << ", by importance " << importance.mean() << " +- "
      << importance.standardError();
  // Importance that is 1% too strong would have been noticed.
  EXPECT_GT(std::abs(light.mean() - 1.01 * importance.mean()), .005 * light.mean());
  // And so would the light that comes by way of the mirror, 2.9% of it.
  EXPECT_LT(irradianceOnGoal(2, 0).mean(), .98 * light.mean());
}

// Importance with a desk as the goal is the radiance with a lamp in place of the desk: of the same geometry,
// and of radiance 1. The desk is black, because a lamp does not reflect. The two runs take different ways
// through the program, so that their random numbers differ. A pane of index 1 and brushed balls, because
// sharp reflections of lamps, other than by mirrors, light nothing; those of goals do.
Sample aroundDesk(const std::string& desk, bool asGoal) {
  std::string text = kRoomWithPane;
  text.replace(text.find("3 .9 .8 .7"), 10, "4 .9 .8 .7 1");
  text += R"(
void metal chrome 0 0 5 .9 .9 .9 1 .2
chrome sphere ball1 0 0 4 2.9 1.2 1.3 .15
chrome sphere ball2 0 0 4 1.8 2.4 1 .2
void dielectric crystal 0 0 5 .9 .95 .98 1.5 0
crystal sphere ball3 0 0 4 1.2 1.7 1.6 .15
void mirror silver 0 0 3 .9 .85 .8
silver polygon mirror 0 0 12 3.98 1 .75 3.98 1 2.2 3.98 2.6 2.2 3.98 2.6 .75
)";
  const std::string names[] = {"desk"};
  const Scene scene = buildScene(
      rad::readSceneText(text + desk + "desk polygon top 0 0 12 2.2 1.6 .7 3 1.6 .7 3 2.1 .7 2.2 2.1 .7\n",
                         "room.rad"),
      {}, asGoal ? std::span<const std::string>(names) : std::span<const std::string>());
  RayOptions options = finely(2);
  options.ambientDivisions = 1;
  const Transport transport(scene, options, IrradianceAt::none);
  const V3d points[] = {V3d(1, 1.2, 1.9), V3d(2.4, .8, 1.2), V3d(1.9, 1.3, .5)};
  Sample sample;
  for (uint64_t rotation = 1; rotation <= 8; ++rotation) {
    SphereOptions sphere;
    sphere.baseDirections = 512;
    // Different rotations, so that equal random numbers do not hide a difference.
    sphere.rotation = asGoal ? rotation : rotation + 1000;
    const SphereEstimator estimator(transport, sphere);
    SphereEstimator::Workspace workspace(estimator);
    double sum = 0;
    for (const V3d& point : points) sum += estimator.estimate(point, workspace).mean.color.y;
    sample.add(sum);
  }
  return sample;
}

TEST(Duality, ImportanceOfADeskIsTheRadianceOfALampInItsPlace) {
  const Sample importance = aroundDesk("void plastic desk 0 0 5 0 0 0 0 0\n", true);
  const Sample lamp = aroundDesk("void light desk 0 0 3 1 1 1\n", false);
  const double error = std::hypot(lamp.standardError(), importance.standardError()) / importance.mean();
  RecordProperty("error", std::to_string(error));
  // Answers are proportional to how bright the lamp is.
  const auto differs = [&](double brighter) {
    return std::abs(brighter * lamp.mean() / importance.mean() - 1) > std::max(.005, 3 * error);
  };
  EXPECT_FALSE(differs(1)) << importance.mean() << " +- " << importance.standardError() << ", with a lamp "
                           << lamp.mean() << " +- " << lamp.standardError();
  // A lamp that is 1% too bright is noticed.
  EXPECT_TRUE(differs(1.01));
}

TEST(Duality, BasicRadianceIsTheSameOutsideOfGlass) {
  const Sample radiance = irradianceByImportance(1, false, 8), basic = irradianceByImportance(1, true, 8);
  EXPECT_NEAR(radiance.mean(), basic.mean(), 4 * std::hypot(radiance.standardError(), basic.standardError()));
}

// Inside glass the radiance from outside is n^2 of what it was; basic radiance is not (Snell; n = 1.5).
TEST(Duality, BasicRadianceLeavesOutTheSquareOfTheIndex) {
  const Scene scene = sceneOf(
      "void dielectric clear 0 0 5 1 1 1 1.5 0\nclear sphere ball 0 0 4 0 0 0 1\n"
      "void glow sky 0 0 4 1 1 1 0\nsky source dome 0 0 4 0 0 1 360\n");
  const auto straightUp = [&](bool basic) {
    const Transport transport(scene, finely(0), IrradianceAt::none, basic);
    PathTracer tracer = transport.pathTracer();
    Sample sample;
    for (uint64_t seed = 0; seed < 200; ++seed)
      sample.add(tracer.trace(V3d(0, 0, 0), V3d(0, 0, 1), 0, seed).value.color.x);
    return sample.mean();
  };
  EXPECT_NEAR(straightUp(false), 1.5 * 1.5, .02);
  EXPECT_NEAR(straightUp(true), 1, .01);
}

}  // namespace
}  // namespace rsphere
