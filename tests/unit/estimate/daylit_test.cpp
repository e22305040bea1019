// Means by daylight: paths from both ends against paths from the eye (-Sk 0).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "glances/diffuse_glances.h"
#include "tests/unit/support/room_with_hole.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"
#include "transport/find_aims.h"

namespace rsphere::daylit_test {
namespace {

const std::string kRoom =
    "void plastic gray 0 0 5 .6 .5 .4 0 0\nvoid glass clear 0 0 3 .9 .92 .9\n" + kRoomWithHole;
const std::string kPane = "clear polygon window 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n";
const std::string kInnerPane = "clear polygon inner 0 0 12 1 .3 1 3 .3 1 3 .3 2 1 .3 2\n";
const std::string kCanopy = "clear polygon canopy 0 0 12 0 -2 2.8 4 -2 2.8 4 -.1 2.8 0 -.1 2.8\n";
const std::string kSky =
    "void glow above 0 0 4 3 4 6 0\nabove source sky 0 0 4 0 0 1 180\n"
    "void glow below 0 0 4 1 .8 .6 0\nbelow source earth 0 0 4 0 0 -1 180\n";
const std::string kSun = "void light solar 0 0 3 4e5 4e5 4e5\nsolar source sun 0 0 4 .2 -.7 .6 .5\n";
const std::string kGround =
    "void plastic soil 0 0 5 .3 .3 .2 0 0\n"
    "soil polygon ground 0 0 12 -20 -30 -.1 20 -30 -.1 20 -.01 -.1 -20 -.01 -.1\n";

const std::string kMirror = "void mirror silver 0 0 3 .9 .9 .9\n";
const std::string kInSun = "silver polygon m 0 0 12 1 .2 .1 3 .2 .1 3 2.2 .1 1 2.2 .1\n";

struct Way {
  const char* name;
  std::string scene;
  int bounces = 2;
  V3d point{2.4, 1.7, 1.1};
  double spoiled = 1.08;  // the error that the test would see
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

SphereSetting settingOf(const std::string& scene, int bounces) {
  return SphereSetting(sceneOf(scene), [&](RayOptions& o) { o.ambientBounces = bounces; });
}

Sample meansOf(const SphereSetting& setting, const V3d& point, double densityFactor, int directions,
               uint64_t rotations = 16) {
  Sample sample;
  for (uint64_t rotation = 0; rotation < rotations; ++rotation) {
    SphereOptions o = setting.options.sphere;
    o.baseDirections = directions;
    o.mostDirections = 2 * directions;
    o.rotation = rotation;
    o.densityFactor = densityFactor;
    const SphereEstimator estimator(*setting.transport, o);
    SphereEstimator::Workspace workspace(estimator);
    sample.add(brightness(estimator.estimate(point, workspace).mean));
  }
  return sample;
}

std::optional<PlainSurfaces> surfacesOf(const SphereSetting& setting) {
  return daylitSurfaces(setting.tracing(setting.transport->aims()));
}

class DaylitWays : public ::testing::TestWithParam<Way> {};

TEST_P(DaylitWays, AgreeWithPathsFromTheEye) {
  const Way& way = GetParam();
  const SphereSetting setting = settingOf(way.scene, way.bounces);
  const auto surfaces = surfacesOf(setting);
  ASSERT_TRUE(surfaces && suitsDaylight(way.point, *surfaces, way.bounces));
  const Sample both = meansOf(setting, way.point, 1, 256, 10), eye = meansOf(setting, way.point, 0, 2048);
  const double error = std::hypot(both.standardError(), eye.standardError());
  EXPECT_LT(std::abs(both.mean() - eye.mean()), kMostSigmas * error)
      << both.mean() << " +- " << both.standardError() << " and " << eye.mean() << " +- "
      << eye.standardError();
  EXPECT_GT(std::abs(way.spoiled * both.mean() - eye.mean()), kMostSigmas * error)
      << "would not see an error of " << way.spoiled << ": " << both.mean() << " +- " << both.standardError()
      << " and " << eye.mean() << " +- " << eye.standardError();
}

INSTANTIATE_TEST_SUITE_P(
    Daylit, DaylitWays,
    ::testing::Values(
        Way{"Pane", kRoom + kPane + kSky}, Way{"Hole", kRoom + kSky},
        Way{"OneBounce", kRoom + kPane + kSky, 1}, Way{"FourBounces", kRoom + kPane + kSky, 4},
        Way{"Sun", kRoom + kPane + kSky + kSun}, Way{"SunOnGround", kRoom + kPane + kSky + kSun + kGround, 3},
        // The pane, which is not known, is outdoors.
        Way{"FrostedPane", kRoom + kSky + kSun +
                               "void trans frost 0 0 7 .9 .9 .9 .02 .1 .8 .3\n"
                               "frost polygon window 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n"},
        // The sun shines through an opening behind an opening.
        Way{"DoublePane", kRoom + kPane + kInnerPane + kSky + kSun},
        Way{"GlassCanopy", kRoom + kCanopy + kSky + kSun, 1, V3d(2.4, 1.7, 1.1)},
        Way{"NearThePane", kRoom + kPane + kSky + kSun, 2, V3d(2.2, .01, 1.6)},
        Way{"MetalShelf",
            kRoom + kPane + kSky + kSun +
                "void metal steel 0 0 5 .8 .8 .8 .9 .02\n"
                "steel polygon shelf 0 0 12 1 .05 .95 3 .05 .95 3 .4 .95 1 .4 .95\n",
            2, V3d(2.4, 1.7, 1.1), 1.2},
        // The mirror throws skylight onto what the point sees.
        Way{"MirrorWithOneBounce",
            kRoom + kPane + kSky + kMirror +
                "silver polygon m 0 0 12 .2 3.9 .2 3.8 3.9 .2 3.8 3.9 2.8 .2 3.9 2.8\n",
            1},
        // The sun, which does not reach the mirror, has an image in it.
        Way{"MirrorInTheShade",
            kRoom + kPane + kSky + kSun + kMirror +
                "silver polygon m 0 0 12 3.1 .01 .5 3.9 .01 .5 3.9 .01 2.5 3.1 .01 2.5\n"},
        Way{"MirrorInTheSun", kRoom + kPane + kSky + kSun + kMirror + kInSun},
        // The sun's light meets the table, then the wall's mirror.
        Way{"TwoMirrorsInTheSun",
            kRoom + kPane + kSky + kSun + kMirror + kInSun +
                "silver polygon n 0 0 12 .2 3.9 .2 3.8 3.9 .2 3.8 3.9 2.8 .2 3.9 2.8\n"},
        Way{"ChromeBall",
            kRoom + kPane + kSky + kSun +
                "void metal chrome 0 0 5 .9 .9 .9 1 0\nchrome sphere b 0 0 4 1.5 2.5 1.2 .4\n"}),
    [](const auto& info) { return info.param.name; });

TEST(Daylit, PointsOutdoorsKeepPathsFromTheEye) {
  const SphereSetting setting = settingOf(kRoom + kPane + kSky + kGround, 2);
  const auto surfaces = surfacesOf(setting);
  ASSERT_TRUE(surfaces);
  EXPECT_TRUE(suitsDaylight(V3d(2, 2, 1), *surfaces, 2));
  EXPECT_FALSE(suitsDaylight(V3d(2, -5, 1), *surfaces, 2));
}

// Light paths carry the light that a mirror throws after it has entered. Of what an outdoor mirror throws
// into the room, paths from both ends would leave answers 5 to 10 times the noise.
TEST(Daylit, MirrorsInTheSunOutdoorsKeepPathsFromTheEye) {
  const std::string light = kSky + kSun + kMirror;
  const std::string below = "silver polygon m 0 0 12 1 -.6 .95 3 -.6 .95 3 -.02 .95 1 -.02 .95\n";
  EXPECT_TRUE(surfacesOf(settingOf(kRoom + kPane + light + kInSun, 2)));
  EXPECT_FALSE(surfacesOf(settingOf(kRoom + kPane + light + below, 2)));
}

// Points beside columns of brushed steel had twice this noise, because few of the directions that see the
// column were continued to the window.
TEST(Daylit, SeveralSamplesAreTakenOfStrongHighlightsInView) {
  const std::string column =
      "void metal steel 0 0 5 .6 .6 .6 .9 .15\nsteel cylinder c 0 0 7 2.4 2.4 0 2.4 2.4 3 .3\n";
  const auto noise = [&](double samples) {
    const SphereSetting setting(sceneOf(kRoom + kPane + kSky + column), [&](RayOptions& o) {
      o.ambientBounces = 0;
      o.specularSampling = samples;
    });
    const Sample means = meansOf(setting, V3d(2.75, 2.3, .8), 1, 128);
    return means.standardError() / means.mean();
  };
  const double usual = noise(1), many = noise(16);
  EXPECT_LT(usual, 1.5 * many);
}

TEST(Daylit, LampsKeepPathsFromTheEye) {
  const std::string lamp =
      "void light lamp 0 0 3 20 20 20\nlamp polygon p 0 0 12 1 1 2.9 1 2 2.9 3 2 2.9 3 1 2.9\n";
  EXPECT_FALSE(surfacesOf(settingOf(kRoom + kPane + kSky + lamp, 2)));
}

}  // namespace
}  // namespace rsphere::daylit_test
