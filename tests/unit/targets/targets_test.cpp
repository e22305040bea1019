#include "targets/targets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere::targets_test {
namespace {

using std::numbers::pi;

Target ballAt(const V3d& center, double density) {
  return {silhouetteOf(Shape(Sphere{center, .5}), {}, V3d(0, 0, 0)), density, 0, false, true, true};
}

Targets::Region regionAt(const Targets& targets, const V3d& direction) {
  return targets.regionAt(direction.normalized());
}

TEST(Targets, DensitiesAddWhereTargetsOverlap) {
  const Targets targets({ballAt(V3d(0, 0, 2), 10), ballAt(V3d(0, 0, 3), 5), ballAt(V3d(4, 0, 0), 1)});
  EXPECT_EQ(regionAt(targets, V3d(0, 0, 1)).density, 15);
  EXPECT_EQ(regionAt(targets, V3d(.2, 0, 1)).density, 10) << "in the wider of the two alone";
  EXPECT_EQ(regionAt(targets, V3d(1, 0, 0)).density, 1);
  EXPECT_EQ(regionAt(targets, V3d(0, -1, 0)).density, 0);
  EXPECT_EQ(regionAt(Targets({}), V3d(0, 0, 1)).density, 0);
}

// The edge of a target that has no edge of its own causes errors, as any other edge.
TEST(Targets, RegionsAreThoseOfTargetsWithTheirOwnEdge) {
  std::vector<Target> three{ballAt(V3d(0, 0, 2), 10), ballAt(V3d(0, 0, 3), 5), ballAt(V3d(4, 0, 0), 1)};
  three[0].fitted = three[0].hasOwnEdge = false;
  three[2].fitted = false;
  const Targets targets(three);
  EXPECT_EQ(regionAt(targets, V3d(0, 0, 1)).fitted, 2u);
  EXPECT_EQ(regionAt(targets, V3d(.2, 0, 1)).fitted, 0u) << "in the wider of the two alone";
  EXPECT_EQ(regionAt(targets, V3d(1, 0, 0)).fitted, 0u);
  EXPECT_NE(regionAt(targets, V3d(0, 0, 1)).id, 0u);
  EXPECT_EQ(regionAt(targets, V3d(.2, 0, 1)).id, 0u);
  EXPECT_NE(regionAt(targets, V3d(1, 0, 0)).id, 0u);
  EXPECT_NE(regionAt(targets, V3d(1, 0, 0)).id, regionAt(targets, V3d(0, 0, 1)).id);
  EXPECT_EQ(regionAt(targets, V3d(0, -1, 0)).id, 0u);
}

// Two parallel panes, and one beside them that shares an edge with the nearer: of those that overlap, the one
// with more directions is fitted.
TEST(TargetChoice, FitsTargetsThatDoNotOverlap) {
  const std::string scene =
      "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid glass clear 0 0 3 .96 .96 .96\n"
      "void light lamp 0 0 3 20 20 20\n"
      "wall bubble room 0 0 4 0 0 0 9\nlamp sphere l 0 0 4 0 0 5 .3\n"
      "clear polygon inner 0 0 12 0 2 0 1 2 0 1 2 1 0 2 1\n"
      "clear polygon outer 0 0 12 0 2.1 0 1 2.1 0 1 2.1 1 0 2.1 1\n"
      "clear polygon beside 0 0 12 1 2 0 2 2 0 2 2 1 1 2 1\n";
  const SphereSetting setting(sceneOf(scene), [](RayOptions& o) { o.ambientBounces = 1; });
  const std::vector<SpecialObject> objects = findSpecialObjects(setting.scene, 1);
  const SeenSources sources(setting.transport->prepared());
  const Targets targets =
      TargetChoice(setting.tracing(), objects, sources, 1).at(V3d(.5, 0, .5), 1e6, 2048, 4096);
  ASSERT_EQ(targets.all().size(), 3u);
  EXPECT_TRUE(targets.all()[0].fitted);
  EXPECT_FALSE(targets.all()[1].fitted);
  EXPECT_TRUE(targets.all()[2].fitted);
}

// Chrome balls in a room that is bright on one side: the radiance on them varies more than around.
struct Setting : SphereSetting {
  Setting()
      : SphereSetting(sceneOf("void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 20 20 20\n"
                              "void metal chrome 0 0 5 .9 .9 .9 1 0\n"
                              "wall bubble room 0 0 4 0 0 0 4\nlamp sphere l 0 0 4 0 0 3 .3\n"
                              "chrome sphere a 0 0 4 1 0 0 .1\nchrome sphere b 0 0 4 0 1 0 .2\n"),
                      [](RayOptions& o) { o.ambientBounces = 1; }) {}
};

struct Choice {
  Setting setting;
  std::vector<SpecialObject> objects = findSpecialObjects(setting.scene, 1);
  SeenSources sources{setting.transport->prepared()};

  Targets at(const V3d& point, double meanBrightness, size_t most, double densityFactor = 1) const {
    return TargetChoice(setting.tracing(), objects, sources, densityFactor)
        .at(point, meanBrightness, 2048, most);
  }
};

TEST(TargetChoice, SendsAsManyAsTheMostToAllAlike) {
  const Choice choice;
  const V3d point(0, 0, 0);
  const Targets all = choice.at(point, 1e-6, 1000000), few = choice.at(point, 1e-6, 10);
  ASSERT_GE(all.all().size(), 2u);
  ASSERT_EQ(all.all().size(), few.all().size());
  double sum = 0;
  for (const Target& target : few.all()) sum += target.expected;
  EXPECT_NEAR(sum, 10, 1e-9);
  const double scale = few.all()[0].density / all.all()[0].density;
  EXPECT_LT(scale, 1);
  for (size_t i = 0; i < all.all().size(); ++i) {
    const Target& target = few.all()[i];
    EXPECT_NEAR(target.density / all.all()[i].density, scale, 1e-12 * scale);
    EXPECT_NEAR(target.expected, target.density * target.silhouette.regionSolidAngle(), 1e-12);
  }
  EXPECT_TRUE(choice.at(point, 1e-6, 0).all().empty());
}

// Without directions of their own, large objects are targets whose solid angle is fitted: 8 of the 2048 base
// directions cover .05 sr. The balls have .03 and .13 sr.
TEST(TargetChoice, SendsNoneWhereAllElseVariesMore) {
  const Targets targets = Choice().at(V3d(0, 0, 0), 1e6, 1000);
  ASSERT_EQ(targets.all().size(), 1u);
  EXPECT_EQ(targets.all()[0].expected, 0);
  EXPECT_TRUE(targets.all()[0].fitted);
  EXPECT_NEAR(targets.all()[0].silhouette.solidAngle(), 2 * pi * (1 - std::sqrt(.96)), 1e-9);
}

TEST(TargetChoice, DensityIsMultiplied) {
  const Choice choice;
  const Targets once = choice.at(V3d(0, 0, 0), .01, 1000000),
                thrice = choice.at(V3d(0, 0, 0), .01, 1000000, 3);
  ASSERT_FALSE(once.all().empty());
  EXPECT_NEAR(thrice.all()[0].density, 3 * once.all()[0].density, 1e-9 * once.all()[0].density);
}

// The sun shines on the floor at 1.5 <= x <= 2.5, 1 <= y <= 2.
TEST(TargetChoice, SunlitFloorsAreTargets) {
  const SphereSetting setting(sceneOf(kSunlitRoom), [](RayOptions& o) { o.ambientBounces = 1; });
  const SeenSources sources(setting.transport->prepared());
  const auto towards = [&](const Aims& aims, const V3d& point, const V3d& place) {
    return regionAt(TargetChoice(setting.tracing(aims), {}, sources, 1).at(point, 1, 2048, 4096),
                    place - point)
        .density;
  };
  const Aims aims = setting.transport->aims();
  const V3d inside(2, 3.5, 1.5), sunlit(2, 1.5, 0), dark(.5, 3, 0);
  EXPECT_GT(towards(aims, inside, sunlit), 0);
  EXPECT_EQ(towards(aims, inside, dark), 0);
  EXPECT_EQ(towards(Aims{}, inside, sunlit), 0) << "nothing is aimed at";
  EXPECT_EQ(towards(aims, V3d(2, 6, 1.5), sunlit), 0) << "hidden by a wall";
  EXPECT_EQ(towards(aims, V3d(2, 1.5, -.005), sunlit), 0) << "below the floor";
}

// A room whose wall at y = 0 has a window without a pane, at 1.1 <= x <= 1.9 and 1 <= z <= 1.7, under an even
// sky.
TEST(TargetChoice, HolesThatShowTheSkyAreTargets) {
  const SphereSetting setting(sceneOf(kRoomWithAWindow), [](RayOptions& o) { o.ambientBounces = 1; });
  const SeenSources sources(setting.transport->prepared());
  const auto at = [&](const Aims& aims, const V3d& point, double meanBrightness) {
    return TargetChoice(setting.tracing(aims), {}, sources, 1).at(point, meanBrightness, 512, 4096);
  };
  const Aims aims = setting.transport->aims();
  ASSERT_TRUE(aims.of<Openings>());
  const V3d near(1.5, 1, 1.35), far(1.5, 4.9, 1.35);
  // 41 base directions per sr: 8 cover .2 sr. The window has .42 sr from near by, .02 sr from far away.
  const Targets even = at(aims, near, 10), bright = at(aims, near, .1), small = at(aims, far, .1);
  ASSERT_EQ(even.all().size(), 1u);
  EXPECT_NEAR(even.all()[0].silhouette.regionSolidAngle(),
              4 * std::atan(.4 * .35 / std::sqrt(1 + .16 + .1225)), 1e-9);
  EXPECT_EQ(even.all()[0].expected, 0) << "the surroundings are brighter";
  EXPECT_TRUE(even.all()[0].fitted);
  ASSERT_EQ(bright.all().size(), 1u);
  EXPECT_GT(bright.all()[0].expected, 0);
  ASSERT_EQ(small.all().size(), 1u);
  EXPECT_TRUE(small.all()[0].fitted) << "enough directions are sent";
  EXPECT_TRUE(at(aims, far, 10).all().empty()) << "it is dim, and has less than one base direction";
  EXPECT_TRUE(at(aims, V3d(1.5, -1, 1.35), .1).all().empty()) << "from the bright side";
  EXPECT_TRUE(at(Aims{}, near, .1).all().empty()) << "nothing is aimed at";
}

// Without special objects and openings nothing is measured.
TEST(Contrasts, NoneOfDiffuseScenes) {
  const Setting setting;
  const SeenSources sources(setting.transport->prepared());
  const Contrasts contrasts(setting.tracing(), {}, sources);
  EXPECT_TRUE(contrasts.objects().empty());
  EXPECT_EQ(contrasts.baseError(), 1);
}

// Contrasts::deviationOn() for all objects that may be seen from a point.
std::vector<double> deviationsFrom(const V3d& point, const Contrasts& contrasts) {
  const Contrasts::View view = contrasts.from(point);
  std::vector<double> deviations;
  for (const uint32_t i : view.objects) deviations.push_back(contrasts.deviationOn(i, *view.region));
  return deviations;
}

// Under a sky that is 1 above and 0 below a mirror shows .9 or 0, with a deviation of at most .45.
TEST(Contrasts, OfAMirrorUnderHalfASphereOfLight) {
  const SphereSetting setting(
      sceneOf("void glow sky 0 0 4 1 1 1 0\nsky source dome 0 0 4 0 0 1 180\n"
              "void metal chrome 0 0 5 .9 .9 .9 1 0\nchrome sphere s 0 0 4 0 0 0 1\n"));
  const auto objects = findSpecialObjects(setting.scene, 1);
  const SeenSources sources(setting.transport->prepared());
  const Contrasts contrasts(setting.tracing(), objects, sources);
  ASSERT_EQ(contrasts.objects().size(), 1u);
  EXPECT_NEAR(deviationsFrom(V3d(0, 0, 5), contrasts)[0], .45, .05);
  EXPECT_GT(contrasts.baseError(), 0);
}

// Objects are measured when they are asked for, and the result does not depend on the order.
TEST(Contrasts, DoNotDependOnTheOrderOfRequests) {
  const SphereSetting setting(
      sceneOf("void glow sky 0 0 4 1 1 1 0\nsky source dome 0 0 4 0 0 1 180\n"
              "void metal dull 0 0 5 .4 .4 .4 1 0\nvoid metal chrome 0 0 5 .9 .9 .9 1 0\n"
              "chrome sphere s 0 0 4 0 0 0 1\ndull sphere t 0 0 4 5 0 0 1\nchrome sphere u 0 0 4 9 0 0 1\n"));
  const auto objects = findSpecialObjects(setting.scene, 1);
  const SeenSources sources(setting.transport->prepared());
  const Contrasts one(setting.tracing(), objects, sources), other(setting.tracing(), objects, sources);
  ASSERT_EQ(one.objects().size(), 3u);
  const V3d point(0, 0, 5);
  const std::vector<double> forwards = deviationsFrom(point, one);
  std::vector<double> backwards(3);
  for (size_t i = 3; i-- > 0;) backwards[i] = other.deviationOn(i, *other.from(point).region);
  EXPECT_EQ(forwards, backwards);
  EXPECT_EQ(forwards[0], forwards[1]) << "both are of chrome";
  EXPECT_GT(forwards[1], forwards[2]);
}

// Many balls of the same material in one lit and three dark storeys: those of the dark ones do not count
// where it is lit, and the other way round.
TEST(Contrasts, AreThoseOfTheStorey) {
  std::string text =
      "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 20 20 20\n"
      "void metal chrome 0 0 5 .9 .9 .9 1 0\nlamp sphere l 0 0 4 2 2 1.5 .3\n";
  for (const double z : {0., 3., 6., 9., 12.})
    text += fmt::format("wall polygon slab{0} 0 0 12 0 0 {0} 40 0 {0} 40 40 {0} 0 40 {0}\n", z);
  for (const double z : {0., 3., 6., 9.})
    for (int i = 0; i < 400; ++i)
      text += fmt::format("chrome sphere s 0 0 4 {} {} {} .01\n", 1.5 + i % 20, 1.5 + i / 20, z + 1);
  const SphereSetting setting(sceneOf(text));
  const auto objects = findSpecialObjects(setting.scene, 1);
  const SeenSources sources(setting.transport->prepared());
  const Contrasts contrasts(setting.tracing(), objects, sources);
  ASSERT_EQ(contrasts.objects().size(), 1600u);
  const std::vector<double> lit = deviationsFrom(V3d(3.2, 3.1, 1.3), contrasts);
  const std::vector<double> dark = deviationsFrom(V3d(3.2, 3.1, 10.3), contrasts);
  ASSERT_LT(lit.size(), 1600u);
  ASSERT_LT(dark.size(), 1600u);
  EXPECT_GT(lit[0], 0);
  EXPECT_EQ(dark[0], 0);
}

}  // namespace
}  // namespace rsphere::targets_test
