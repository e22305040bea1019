// The parts of contributors (-Sp): of goals, and of lamps and skies.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "estimate/estimator.h"
#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "scene/contributors.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::parts_of_contributors_test {
namespace {

using Names = std::vector<std::string>;

Scene sceneWith(const std::string& text, const Names& goals, bool separate) {
  Scene scene = buildScene(rad::readSceneText(text, "room.rad"), {}, goals);
  if (separate) separateContributors(scene, goals);
  return scene;
}

struct Case {
  const char* name;
  std::string more;     // scene text beside room()
  double accuracy = 0;  // -aa
  Weights weights = Weights::silhouettes;
  double wanted = 0;  // -Sa
};

PointAnswer answer(const std::string& text, const Names& goals, bool separate, const Case& how) {
  SphereSetting setting(sceneWith(text, goals, separate), [&](RayOptions& o) {
    o.ambientBounces = 2;
    o.ambientAccuracy = how.accuracy;
    if (how.accuracy > 0) o.leastForPatches = 64;
  });
  SphereOptions o = setting.options.sphere;
  o.weights = how.weights;
  o.baseDirections = 512;
  o.mostDirections = 1024;
  o.accuracy = how.wanted;
  o.mostForAccuracy = 8192;
  const SphereEstimator estimator(*setting.transport, o, true);
  SphereEstimator::Workspace workspace(estimator);
  return estimator.estimate(V3d(2.2, 1.4, 2.3), workspace);
}

std::string polygon(const std::string& modifier, const std::string& corners) {
  return fmt::format("{} polygon p 0 0 {} {}\n", modifier,
                     std::count(corners.begin(), corners.end(), ' ') + 1, corners);
}

// A room of 5 x 4 x 3 m with three desks. open: without one of the walls.
std::string room(bool open = false) {
  std::string text =
      "void plastic wall 0 0 5 .6 .55 .5 0 0\nvoid plastic desk1 0 0 5 .4 .3 .2 0 0\n"
      "void plastic desk2 0 0 5 .5 .5 .5 .04 .1\nvoid metal desk3 0 0 5 .7 .7 .7 .9 .2\n";
  text += polygon("wall", "0 0 0 5 0 0 5 4 0 0 4 0") + polygon("wall", "0 0 3 0 4 3 5 4 3 5 0 3");
  text += polygon("wall", "0 0 0 0 0 3 5 0 3 5 0 0") + polygon("wall", "0 4 0 5 4 0 5 4 3 0 4 3");
  text += polygon("wall", "0 0 0 0 4 0 0 4 3 0 0 3");
  if (!open) text += polygon("wall", "5 0 0 5 0 3 5 4 3 5 4 0");
  text += polygon("desk1", "1 .8 .7 2 .8 .7 2 1.5 .7 1 1.5 .7");
  text += polygon("desk2", "3 2 .7 4 2 .7 4 3 .7 3 3 .7");
  return text + polygon("desk3", ".5 3 .7 1.5 3 .7 1.5 3.6 .7 .5 3.6 .7");
}

const Names kGoals = {"desk1", "desk2", "desk3"};

const std::string kCrystal =
    "void dielectric crystal 0 0 5 .9 .95 .9 1.5 0\ncrystal sphere c 0 0 4 2 2 1.6 .3\n";
const std::string kScreen =
    "void trans silk 0 0 7 .5 .5 .6 .05 .1 .4 .3\n" + polygon("silk", "2.5 1 .2 2.5 3 .2 2.5 3 2 2.5 1 2");
const std::string kMirrors = "void mirror silver 0 0 3 .8 .9 .8\nvoid glass pane 0 0 3 .9 .8 .9\n" +
                             polygon("silver", ".01 1 1 .01 3 1 .01 3 2 .01 1 2") +
                             polygon("pane", "2.8 1 .2 2.8 3 .2 2.8 3 2 2.8 1 2") +
                             "silver sphere s 0 0 4 3.6 1 1.8 .1\n";
const std::string kWoven =
    "void brightfunc stripes 2 if(Px-1.5,1,.3) . 0 0\nstripes plastic woven 0 0 5 .5 .3 .3 0 0\n" +
    polygon("woven", "1 1.8 .3 4 1.8 .3 4 2.2 .3 1 2.2 .3");

std::vector<Case> cases() {
  return {{"paths from both ends", ""},
          {"mirrors and panes", kMirrors},
          {"a crystal and a screen", kCrystal + kScreen},
          {"a pattern and a mist", kWoven + "void mist fog 0 0 4 .1 .1 .1 .5\nfog sphere f 0 0 4 4 3 2 .4\n"},
          {"interpolated light", kWoven, .2, Weights::voronoi},
          {"equal weights", kMirrors, 0, Weights::homogeneous},
          {"cells", kMirrors, 0, Weights::voronoi},
          {"an accuracy", kMirrors, 0, Weights::silhouettes, .02}};
}

// Lamps, one of them with a pattern, a spot, a glow, an illum and a sky behind a window.
std::string lamps() {
  return "void light lamp1 0 0 3 20 18 15\nvoid light lamp2 0 0 3 5 6 9\n"
         "void spotlight spot 0 0 7 50 50 50 40 0 0 -1\nvoid glow near 0 0 4 2 2 2 3\n"
         "void brightfunc uneven 2 1+.5*Dx . 0 0\nuneven light lamp3 0 0 3 10 10 10\n"
         "void illum window 0 0 3 3 4 5\nvoid glow sky 0 0 4 .4 .5 .9 0\nsky source s 0 0 4 0 0 1 180\n" +
         polygon("lamp1", "1 1 2.9 1 1.3 2.9 1.8 1.3 2.9 1.8 1 2.9") + "lamp2 sphere b 0 0 4 3 2 2 .1\n" +
         polygon("spot", "4 1 2.9 4 1.1 2.9 4.1 1.1 2.9 4.1 1 2.9") +
         polygon("near", "1 3 .9 1.2 3 .9 1.2 3.2 .9 1 3.2 .9") +
         polygon("lamp3", "3.5 3 2.9 3.5 3.3 2.9 4 3.3 2.9 4 3 2.9") +
         polygon("window", "4.99 1 1 4.99 1 2 4.99 2 2 4.99 2 1");
}

void expectSameColor(const Color& a, const Color& b, const char* what, double tolerance) {
  const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance * size) << what << ", channel " << c;
}

// With parts, an answer is the same, and the parts add up to it.
void expectParts(const std::string& text, const Names& goals, size_t contributors, const Case& how) {
  const PointAnswer plain = answer(text, goals, false, how), divided = answer(text, goals, true, how);
  constexpr double tolerance = 1e-12;
  EXPECT_EQ(plain.directions, divided.directions);
  EXPECT_GT(brightness(plain.mean), 0);
  const auto check = [&](const Color& one, const Color& other, const char* what) {
    expectSameColor(one, Color(other.rgb()), what, tolerance);
    Color sum(0);
    size_t some = 0;
    for (size_t i = 0; i < contributors; ++i) {
      sum += other.part(i);
      some += brightness(other.part(i)) > 0;
    }
    expectSameColor(one, sum, what, tolerance);
    EXPECT_EQ(some, contributors) << what;
    EXPECT_EQ(other.part(contributors), Color(0));
  };
  check(plain.mean.color, divided.mean.color, "mean");
  check(plain.cylindricalIrradiance.color, divided.cylindricalIrradiance.color, "cylindrical");
  for (int i = 0; i < 6; ++i)
    expectSameColor(plain.facing[i].color, Color(divided.facing[i].color.rgb()), "face", tolerance);
  expectSameColor(plain.standardError.color, Color(divided.standardError.color.rgb()), "error", tolerance);
}

TEST(PartsOfContributors, OfGoalsAddUpToTheAnswerWithoutThem) {
  for (const Case& how : cases()) {
    SCOPED_TRACE(how.name);
    expectParts(room() + how.more, kGoals, 3, how);
  }
}

TEST(PartsOfContributors, OfLampsAddUpToTheAnswerWithoutThem) {
  for (const Case& how : cases()) {
    SCOPED_TRACE(how.name);
    expectParts(room(true) + lamps() + how.more, {}, 7, how);
  }
}

// Whether the parts of goals are what the goals give alone, within four standard errors of both. factor:
// spoils the parts.
bool partsAreThoseOfGoalsAlone(const Case& how, double factor) {
  const std::string text = room() + how.more;
  const PointAnswer together = answer(text, kGoals, true, how);
  bool same = true;
  for (size_t i = 0; i < kGoals.size(); ++i) {
    const PointAnswer alone = answer(text, {kGoals[i]}, false, how);
    const double difference = brightness(together.mean.color.part(i)) * factor - brightness(alone.mean);
    const double error = std::hypot(brightness(together.standardError.color.part(i)), alone.brightnessError);
    same = same && std::abs(difference) < 4 * error;
  }
  return same;
}

TEST(PartsOfContributors, AreWhatEachGoalGivesAlone) {
  for (const Case& how : cases()) {
    SCOPED_TRACE(how.name);
    EXPECT_TRUE(partsAreThoseOfGoalsAlone(how, 1));
    EXPECT_FALSE(partsAreThoseOfGoalsAlone(how, how.weights == Weights::silhouettes ? 1.3 : 4));
  }
}

// What rays find in ray mode, with three diffuse bounces. accuracy: -aa.
std::vector<Radiance> ofRays(const std::string& text, const Names& goals, bool separate, double accuracy,
                             uint64_t seed) {
  const Scene scene = sceneWith(text, goals, separate);
  RayOptions options = modeDefaults(false).ray;
  options.ambientBounces = 3;
  options.ambientAccuracy = accuracy;
  options.ambientDivisions = 64;
  options.rotation = seed;
  const Transport transport(scene, options, IrradianceAt::none);
  PathTracer tracer = transport.pathTracer();
  std::vector<Radiance> found;
  for (const V3d& towards : {V3d(0, .3, -1), V3d(-1, -1, -.6), V3d(.5, 1, .4), V3d(-1, .7, .9)})
    found.push_back(tracer.trace(V3d(2.2, 1.4, 2.3), towards.normalized(), 0, mixBits(seed)).value);
  return found;
}

void expectPartsOfRays(const std::string& text, const Names& goals, size_t contributors) {
  for (const double accuracy : {.2, 0.}) {
    const auto plain = ofRays(text, goals, false, accuracy, 1);
    const auto divided = ofRays(text, goals, true, accuracy, 1);
    for (size_t ray = 0; ray < plain.size(); ++ray) {
      Color sum(0);
      for (size_t i = 0; i < contributors; ++i) sum += divided[ray].color.part(i);
      EXPECT_GT(brightness(plain[ray]), 0);
      expectSameColor(plain[ray].color, Color(divided[ray].color.rgb()), "ray", 1e-12);
      expectSameColor(plain[ray].color, sum, "sum over contributors", 1e-12);
    }
  }
}

TEST(PartsOfContributors, OfInterpolatedLightAddUp) {
  for (const std::string& more : {kMirrors, kCrystal + kScreen + kWoven}) {
    expectPartsOfRays(room() + more, kGoals, 3);
    expectPartsOfRays(room(true) + lamps() + more, {}, 7);
  }
}

// The parts of each contributor, added up over the rays, in several runs.
std::vector<Sample> partsOfRays(const std::string& text, const Names& goals, size_t contributors,
                                double accuracy) {
  std::vector<Sample> parts(contributors);
  for (uint64_t run = 1; run <= 4; ++run) {
    const auto rays = ofRays(text, goals, true, accuracy, run);
    for (size_t i = 0; i < contributors; ++i) {
      double sum = 0;
      for (const Radiance& ray : rays) sum += brightness(ray.color.part(i));
      parts[i].add(sum);
    }
  }
  return parts;
}

// Each part of interpolated light is that of rays that are followed, within noise and 2% of the sum of all
// parts; parts that are 15% larger are not.
void expectPartsOfFollowedRays(const std::string& text, const Names& goals, size_t contributors) {
  const auto interpolated = partsOfRays(text, goals, contributors, .1);
  const auto followed = partsOfRays(text, goals, contributors, 0);
  double whole = 0;
  for (const Sample& part : followed) whole += part.mean();
  const auto isSame = [&](size_t i, double factor) {
    const double error = std::hypot(factor * interpolated[i].standardError(), followed[i].standardError());
    const double difference = factor * interpolated[i].mean() - followed[i].mean();
    return std::abs(difference) < kMostSigmas * error + .02 * whole;
  };
  bool spoiledIsSame = true;
  for (size_t i = 0; i < contributors; ++i) {
    EXPECT_TRUE(isSame(i, 1)) << "contributor " << i;
    spoiledIsSame = spoiledIsSame && isSame(i, 1.15);
  }
  EXPECT_FALSE(spoiledIsSame);
}

TEST(PartsOfContributors, OfInterpolatedLightAreThoseOfFollowedRays) {
  expectPartsOfFollowedRays(room() + kWoven, kGoals, 3);
  expectPartsOfFollowedRays(room(true) + lamps() + kMirrors, {}, 7);
}

TEST(PartsOfContributors, HaveTheNamesInTheirOrder) {
  EXPECT_EQ(sceneWith(room(), {"desk3", "desk1"}, true).contributors, (Names{"desk3", "desk1"}));
  EXPECT_EQ(sceneWith(room() + lamps(), {}, true).contributors,
            (Names{"lamp1", "lamp2", "spot", "near", "lamp3", "window", "sky"}));
  EXPECT_TRUE(sceneWith(room(), {"desk3"}, false).contributors.empty());
}

TEST(PartsOfContributors, OfTheSameNameAreOne) {
  const std::string twice =
      "void light lamp 0 0 3 5 5 5\nlamp sphere a 0 0 4 1 1 2 .1\n"
      "void light lamp 0 0 3 7 7 7\nlamp sphere b 0 0 4 3 1 2 .1\n";
  EXPECT_EQ(sceneWith(room() + twice, {}, true).contributors, Names{"lamp"});
}

std::string errorOf(const std::string& text, const Names& goals) {
  try {
    sceneWith(text, goals, true);
  } catch (const rad::Error& error) {
    return error.what();
  }
  return "";
}

TEST(PartsOfContributors, AreRefusedWhereThereAreNone) {
  EXPECT_EQ(errorOf(room(), {}), "-Sp: the scene has neither goals (-Sg) nor light sources");
  EXPECT_EQ(errorOf(room(), {"desk1", "desk2", "desk1"}), "-Sg desk1: the goal is given twice");
  EXPECT_EQ(errorOf(room(), {"desk1", "desk1"}), "-Sg desk1: the goal is given twice");
  std::string many = room();
  for (int i = 0; i <= 1000; ++i)
    many += fmt::format("void light l{0} 0 0 3 1 1 1\nl{0} sphere s 0 0 4 1 1 1 .01\n", i);
  EXPECT_EQ(errorOf(many, {}), "-Sp: 1001 contributors, but at most 1000 are possible");
}

}  // namespace
}  // namespace rsphere::parts_of_contributors_test
