// Sensors as goals: what a lamp of 1 cd at a point gives a sensor is 4 pi times the mean importance at the
// point.
#include "scene/sensors.h"

#include <gtest/gtest.h>

#include <string>

#include "base/constants.h"
#include "estimate/estimator.h"
#include "scene/contributors.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::sensors_test {
namespace {

using Sensors = std::vector<Sensor>;

const V3d kSmallLamp(1, 1.2, 1.9);
const Sensor kOnDesk{V3d(2.6, 1.6, .7), V3d(.6, 0, .8)};

// A room of 4 x 3 x 2.5 m.
std::string roomOf(const std::string& wall) {
  return "void plastic wall 0 0 5 " + wall + R"( 0 0
wall polygon floor 0 0 12 0 0 0 4 0 0 4 3 0 0 3 0
wall polygon ceiling 0 0 12 0 0 2.5 0 3 2.5 4 3 2.5 4 0 2.5
wall polygon south 0 0 12 0 0 0 0 0 2.5 4 0 2.5 4 0 0
wall polygon east 0 0 12 4 0 0 4 0 2.5 4 3 2.5 4 3 0
wall polygon north 0 0 12 4 3 0 4 3 2.5 0 3 2.5 0 3 0
wall polygon west 0 0 12 0 3 0 0 3 2.5 0 0 2.5 0 0 0
)";
}

const std::string kPaneInRoom = R"(void glass pane 0 0 3 .9 .8 .7
pane polygon window 0 0 12 1.6 1.2 1.3 1.6 1.5 1.3 1.6 1.5 1.6 1.6 1.2 1.6
)";

// The small lamp lies behind a pane of glass: small, too, because rays in rtrace's manner leave out the
// light of lamps that panes reflect, and importance does not. A ball stands between it and the desk, and a
// mirror hangs on the wall that the sensor on the desk faces.
const std::string kRoomWithSensor =
    roomOf(".6 .5 .4") + kPaneInRoom + R"(void plastic paint 0 0 5 .5 .5 .5 .02 .1
paint sphere ball 0 0 4 2.9 1.2 1.3 .15
void mirror silver 0 0 3 .9 .85 .8
silver polygon mirror 0 0 12 3.98 1 .75 3.98 1 2.2 3.98 2.6 2.2 3.98 2.6 .75
)";

RayOptions fine(int bounces) {
  RayOptions o;
  o.ambientBounces = bounces;
  o.ambientAccuracy = 0;
  o.ambientDivisions = 4;
  o.ambientSuperSamples = 0;
  o.directThreshold = 0;
  o.directJitter = 1;
  o.specularThreshold = 0;
  o.weightLimit = 1e-6;
  return o;
}

// The illuminance of the sensor by rays from it, with a lamp of 1 cd, and one bounce more than importance
// has.
Sample forward(const std::string& room, int bounces, int relays, int count) {
  // A sphere of 1 cm and the radiance of 1 cd.
  const std::string lamp =
      "void light bright 0 0 3 3183.0989 3183.0989 3183.0989\n"
      "bright sphere lamp 0 0 4 1 1.2 1.9 .01\n";
  const Scene scene = sceneOf(room + lamp);
  RayOptions options = fine(bounces + 1);
  options.directRelays = relays;
  const Transport transport(scene, options, IrradianceAt::point);
  PathTracer tracer = transport.pathTracer();
  Random random(7);
  Sample sample;
  for (int i = 0; i < count; ++i)
    sample.add(
        tracer.trace(kOnDesk.point + 1e-4 * kOnDesk.normal, -kOnDesk.normal, 0, random.bits()).value.color.y);
  return sample;
}

// 4 pi times the mean importance at the lamp (lx/cd), of each rotation.
Sample byImportance(const std::string& room, const Sensors& sensors, int bounces, uint64_t rotations) {
  Scene scene = sceneOf(room);
  addSensors(scene, sensors);
  const Transport transport(scene, fine(bounces), IrradianceAt::none);
  Sample sample;
  for (uint64_t rotation = 1; rotation <= rotations; ++rotation) {
    SphereOptions options;
    options.baseDirections = 512;
    options.rotation = rotation;
    const SphereEstimator estimator(transport, options);
    SphereEstimator::Workspace workspace(estimator);
    sample.add(4 * kPi * estimator.estimate(kSmallLamp, workspace).mean.color.y);
  }
  return sample;
}

// In a black room.
double directOf(const Sensors& sensors, const std::string& more = "") {
  return byImportance(roomOf("0 0 0") + more, sensors, 0, 1).mean();
}

double byCosine(const Sensor& sensor, const V3d& lamp) {
  const V3d to = lamp - sensor.point;
  return sensor.normal.dot(to.normalized()) / to.length2();
}

TEST(Sensors, ReceiveWhatRaysFromThemBring) {
  const Sample light = forward(kRoomWithSensor, 2, 2, 60000);
  const Sample importance = byImportance(kRoomWithSensor, {kOnDesk}, 2, 40);
  const double error = std::hypot(light.standardError(), importance.standardError());
  RecordProperty("light", std::to_string(light.standardError() / light.mean()));
  RecordProperty("importance", std::to_string(importance.standardError() / importance.mean()));
  RecordProperty("difference", std::to_string(importance.mean() / light.mean() - 1));
  // Both together must be surer than what the comparison has to see.
  EXPECT_LT(3 * error, .005 * light.mean());
  EXPECT_LT(std::abs(light.mean() - importance.mean()), .005 * light.mean())
      << light.mean() << " +- " << light.standardError() << ", by importance " << importance.mean() << " +- "
      << importance.standardError();
  // Importance that is 1% too strong would have been noticed, and so would the light by way of the mirror.
  EXPECT_GT(std::abs(light.mean() - 1.01 * importance.mean()), .005 * light.mean());
  EXPECT_LT(forward(kRoomWithSensor, 2, 0, 5000).mean(), .95 * light.mean());
}

// A pane before the sensor mirrors the room to it, whose light is indirect: a screen hides all from the lamp.
TEST(Sensors, ReceiveWhatPanesReflect) {
  const auto room = [](const char* pane) {
    return roomOf(".6 .5 .4") +
           "wall polygon screen 0 0 12 2.2 0 0 2.2 3 0 2.2 3 2.2 2.2 0 2.2\nvoid glass clear 0 0 " + pane +
           "\nclear polygon window 0 0 12 2.9 .2 .1 2.9 2.8 .1 2.9 2.8 1.8 2.9 .2 1.8\n";
  };
  const std::string usual = room("3 .95 .95 .95");
  const Sample light = forward(usual, 2, 2, 60000), importance = byImportance(usual, {kOnDesk}, 2, 40);
  const double error = std::hypot(light.standardError(), importance.standardError());
  RecordProperty("error", std::to_string(error / light.mean()));
  RecordProperty("difference", std::to_string(importance.mean() / light.mean() - 1));
  EXPECT_LT(3 * error, .015 * light.mean());
  EXPECT_NEAR(light.mean(), importance.mean(), .015 * light.mean());
  // Index 1: without reflections.
  const double without = byImportance(room("4 .95 .95 .95 1"), {kOnDesk}, 2, 40).mean();
  EXPECT_GT(std::abs(without / light.mean() - 1), .03);
}

TEST(Sensors, HaveExactDirectLight) {
  const Sensor wall{V3d(.5, .5, 1.2), V3d(1, 0, 0)}, floor{V3d(1.2, 2.8, 0), V3d(0, 0, 1)};
  for (const Sensor& sensor : {wall, floor}) {
    const double exact = byCosine(sensor, kSmallLamp);
    EXPECT_NEAR(directOf({sensor}), exact, 1e-8 * exact);
    EXPECT_GT(std::abs(directOf({{sensor.point + V3d(0, 0, 1e-4), sensor.normal}}) - exact), 1e-5 * exact);
  }
}

TEST(Sensors, ReceiveNothingFromBehind) { EXPECT_EQ(directOf({{V3d(.5, .5, 1.2), V3d(-1, 0, 0)}}), 0); }

// On the line between the lamp and a sensor, and in the same place, stand others that face elsewhere.
TEST(Sensors, StandInNobodysWay) {
  const Sensor seen{V3d(.5, .5, 1.2), V3d(1, 0, 0)};
  const V3d away = (seen.point - kSmallLamp).normalized();
  const Sensor between{(seen.point + kSmallLamp) / 2, away};
  EXPECT_EQ(directOf({seen, between}), directOf({seen}));
  EXPECT_NEAR(directOf({{seen.point, away}, seen}), directOf({seen}), 1e-4 * directOf({seen}));
  // Behind the pane, rays are followed.
  const Sensor behind{kOnDesk.point, V3d(0, 0, 1)};
  const Sensor among{(behind.point + kSmallLamp) / 2 + V3d(.1, 0, 0), V3d(1, 0, 0)};
  const double one = directOf({behind}, kPaneInRoom);
  EXPECT_NEAR(directOf({behind, behind, among}, kPaneInRoom), 2 * one, 1e-4 * one);
  EXPECT_GT(one, .5 * byCosine(behind, kSmallLamp));
}

// An octree's surfaces come behind those of the world, among which sensors are.
TEST(Sensors, AreAddedBeforeSurfacesOfOtherGroups) {
  Scene scene = sceneOf(roomOf(".5 .5 .5"));
  scene.groups.push_back({{scene.surfaces.size(), 0}});
  const size_t before = scene.surfaces.size();
  scene.surfaces.push_back(Sphere{V3d(0, 0, 0), 1}, 0, scene.surfaces.primitiveOf(SurfaceId(0)));
  scene.names.push_back("inner");
  scene.groups[1].surfaces = {before, 1};
  addSensors(scene, Sensors{kOnDesk, kOnDesk});
  EXPECT_EQ(scene.surfaces.size(), before + 3);
  EXPECT_EQ(scene.outermostIds().size(), before + 2);
  EXPECT_EQ(scene.groups[1].surfaces[0], SurfaceId(before + 2));
  EXPECT_TRUE(scene.surfaces.at(before + 2).shape.as<Sphere>());
  EXPECT_TRUE(scene.surfaces.at(before).finish.sensor);
  EXPECT_EQ(scene.surfaceName(scene.surfaces.at(before + 1)), "sensor2");
  EXPECT_EQ(scene.surfaceName(scene.surfaces.at(0)), "floor");
}

TEST(Sensors, AreRefusedWithTheirNumber) {
  const auto faultOf = [](std::vector<double> numbers) -> std::string {
    try {
      sensorsOf(numbers, "s.txt");
    } catch (const rad::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(faultOf({1, 2, 3, 0, 0, 2}), "");
  EXPECT_EQ(faultOf({1, 2, 3, 0, 0, 2, 1, 2, 3, 0, 0, 0}),
            "s.txt: sensor 2: the direction that it faces is 0 0 0");
  EXPECT_EQ(faultOf({1, 2, std::numeric_limits<double>::infinity(), 0, 0, 1}),
            "s.txt: sensor 1: a coordinate is not a finite number");
}

}  // namespace
}  // namespace rsphere::sensors_test
