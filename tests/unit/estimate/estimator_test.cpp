#include "estimate/estimator.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

std::string box(const char* modifier, const V3d& low, const V3d& high) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      V3d u(0, 0, 0), v(0, 0, 0);
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      u[a] = high[a] - low[a];
      v[b] = high[b] - low[b];
      V3d p = low;
      if (upper) p[axis] = high[axis];
      text += fmt::format("{} polygon b 0 0 12", modifier);
      for (const V3d& corner : {p, p + u, p + u + v, p + v})
        text += fmt::format(" {} {} {}", corner.x, corner.y, corner.z);
      text += '\n';
    }
  return text;
}

// A room of 6 x 5 x 3 m with two luminaires, a table, a cupboard and mirror spheres. With opaque polygons
// their back sides scatter as their fronts do.
std::string room(int spheres, double radius = .1, double luminaire = .8) {
  std::string text =
      "void plastic wall 0 0 5 .6 .6 .55 0 0\nvoid plastic wood 0 0 5 .4 .25 .15 0 0\n"
      "void light lamp 0 0 3 20 20 20\nvoid mirror silver 0 0 3 .9 .9 .9\n";
  text += box("wall", V3d(0, 0, 0), V3d(6, 5, 3));
  text += box("wood", V3d(2, 1.5, .7), V3d(4, 2.5, .75));
  text += box("wood", V3d(5.4, 1, 0), V3d(5.9, 3, 2));
  for (const double y : {1., 3.})
    text += fmt::format("lamp polygon p 0 0 12 2 {0} 2.9 2 {1} 2.9 4 {1} 2.9 4 {0} 2.9\n", y, y + luminaire);
  Random random(1);
  for (int i = 0; i < spheres; ++i)
    text += fmt::format("silver sphere s 0 0 4 {} {} {} {}\n", between(random, .5, 5.2),
                        between(random, .5, 4.5), between(random, 1.6, 2.6), radius);
  return text;
}

struct Setting : SphereSetting {
  explicit Setting(const std::string& text, int bounces = 0)
      : SphereSetting(sceneOf(text), [&](RayOptions& o) { o.ambientBounces = bounces; }) {}
  // Of the mode's options, with these.
  SphereOptions with(Weights weights, int base, uint64_t rotation = 0) const {
    SphereOptions o = options.sphere;
    o.weights = weights;
    o.baseDirections = base;
    o.mostDirections = 2 * base;
    o.rotation = rotation;
    return o;
  }
  PointAnswer at(const V3d& point, const SphereOptions& o) const {
    const SphereEstimator estimator(*transport, o);
    SphereEstimator::Workspace workspace(estimator);
    return estimator.estimate(point, workspace);
  }
};

double sumOf(const std::vector<DirectionSample>& samples) {
  double sum = 0;
  for (const DirectionSample& s : samples) sum += s.solidAngle;
  return sum;
}

constexpr Weights kAllWeights[] = {Weights::homogeneous, Weights::voronoi, Weights::silhouettes};

// Silhouettes against brute force.
TEST(Estimator, AgreesWithEqualWeights) {
  const Setting setting(room(12), 1);
  const V3d point(2.2, 3.4, 1.5);
  Sample equal, silhouettes;
  for (uint64_t rotation = 0; rotation < 30; ++rotation)
    silhouettes.add(brightness(setting.at(point, setting.with(Weights::silhouettes, 512, rotation)).mean));
  for (uint64_t rotation = 0; rotation < 24; ++rotation)
    equal.add(brightness(setting.at(point, setting.with(Weights::homogeneous, 10000, rotation)).mean));
  const double error = std::hypot(equal.standardError(), silhouettes.standardError());
  EXPECT_LT(std::abs(silhouettes.mean() - equal.mean()), 3 * error)
      << silhouettes.mean() << " +- " << silhouettes.standardError() << " and " << equal.mean() << " +- "
      << equal.standardError();
  EXPECT_GT(std::abs(1.01 * silhouettes.mean() - equal.mean()), 3 * error) << "would not see an error of 1%";
}

// Small luminaires are what equal weights miss, or hit once too often.
TEST(Estimator, ScattersFarLessThanEqualWeights) {
  const Setting setting(room(12, .1, .1));
  const V3d point(2.2, 3.4, 1.5);
  Sample reference;
  for (uint64_t rotation = 100; rotation < 103; ++rotation)
    reference.add(brightness(setting.at(point, setting.with(Weights::silhouettes, 8192, rotation)).mean));
  Sample square, equalSquare;
  size_t most = 0;
  for (uint64_t rotation = 0; rotation < 30; ++rotation) {
    const PointAnswer a = setting.at(point, setting.with(Weights::silhouettes, 512, rotation));
    square.add(std::pow(brightness(a.mean) / reference.mean() - 1, 2));
    most = std::max(most, a.directions);
  }
  for (uint64_t rotation = 0; rotation < 30; ++rotation) {
    const SphereOptions o = setting.with(Weights::homogeneous, static_cast<int>(most), rotation);
    equalSquare.add(std::pow(brightness(setting.at(point, o).mean) / reference.mean() - 1, 2));
  }
  const double ratio = std::sqrt(equalSquare.mean() / square.mean());
  RecordProperty("ratio", static_cast<int>(100 * ratio));
  EXPECT_GT(ratio, 5) << "rms " << std::sqrt(square.mean()) << " with at most " << most << " directions";
}

TEST(Estimator, SolidAnglesSumToTheSphere) {
  const Setting setting(room(20));
  // In the room, on a wall, in the middle of a sphere and on a luminaire.
  const auto& sphere = *setting.scene.surfaces[setting.scene.surfaces.last()].shape.as<Sphere>();
  for (const Weights weights : kAllWeights) {
    const SphereEstimator estimator(*setting.transport, setting.with(weights, 500));
    SphereEstimator::Workspace workspace(estimator);
    for (const V3d& p : {V3d(1, 1, 1), V3d(3, 2.5, 0), sphere.center, sphere.center + V3d(.1, 0, 0),
                         V3d(3, 1.4, 2.9), V3d(100, 0, 1e4)}) {
      const PointAnswer a = estimator.estimate(p, workspace);
      EXPECT_NEAR(sumOf(workspace.samples), 4 * kPi, 1e-9) << static_cast<int>(weights) << ' ' << p;
      EXPECT_EQ(a.directions, workspace.samples.size());
      EXPECT_TRUE(std::isfinite(brightness(a.mean))) << p;
    }
  }
}

TEST(Estimator, NoSpecialObjectNoDynamicDirection) {
  const Setting setting("void plastic wall 0 0 5 .5 .5 .5 0 0\n" + box("wall", V3d(0, 0, 0), V3d(6, 5, 3)));
  for (const Weights weights : kAllWeights) {
    const PointAnswer a = setting.at(V3d(1, 2, 1), setting.with(weights, 700));
    EXPECT_EQ(a.directions, 700u) << static_cast<int>(weights);
  }
}

TEST(Estimator, DynamicDirectionsWhereThereAreSpecialObjects) {
  const Setting setting(room(12));
  EXPECT_GT(setting.at(V3d(2, 2, 1.5), setting.with(Weights::voronoi, 700)).directions, 700u);
  EXPECT_EQ(setting.at(V3d(2, 2, 1.5), setting.with(Weights::homogeneous, 700)).directions, 700u);
}

TEST(Estimator, TenThousandSpecialObjectsStayWithinTheMost) {
  const Setting setting(room(10000, .005));
  for (const Weights weights : {Weights::voronoi, Weights::silhouettes}) {
    const SphereOptions o = setting.with(weights, 500);
    const PointAnswer a = setting.at(V3d(2.2, 3.4, 1.2), o);
    EXPECT_LE(a.directions, static_cast<size_t>(o.mostDirections)) << static_cast<int>(weights);
    EXPECT_GT(brightness(a.mean), 0);
    EXPECT_TRUE(std::isfinite(brightness(a.mean)));
  }
}

TEST(Estimator, AnswersDoNotDependOnThoseBefore) {
  const Setting setting(room(12), 1);
  for (const Weights weights : kAllWeights) {
    const SphereEstimator estimator(*setting.transport, setting.with(weights, 300));
    SphereEstimator::Workspace used(estimator), fresh(estimator);
    for (const V3d& p : {V3d(1, 1, 1), V3d(4, 4, 2), V3d(1, 1, 1)}) estimator.estimate(p, used);
    const PointAnswer later = estimator.estimate(V3d(2, 3, 1.5), used);
    const PointAnswer first = estimator.estimate(V3d(2, 3, 1.5), fresh);
    EXPECT_EQ(first.mean.color, later.mean.color);
    EXPECT_EQ(first.lightVector, later.lightVector);
    ASSERT_EQ(used.samples.size(), fresh.samples.size());
    for (size_t i = 0; i < used.samples.size(); ++i) {
      ASSERT_EQ(used.samples[i].direction, fresh.samples[i].direction);
      ASSERT_EQ(used.samples[i].solidAngle, fresh.samples[i].solidAngle);
    }
  }
}

TEST(Estimator, SameAnswerInAScaledScene) {
  // Sizes and distances by a power of two: nothing but rounding may differ.
  const auto ball = [](double k) {
    return fmt::format(
        "void light lamp 0 0 3 5 5 5\nvoid mirror silver 0 0 3 .9 .9 .9\nvoid plastic gray 0 0 5 .5 .5 .5 0 "
        "0\n"
        "lamp sphere l 0 0 4 0 0 {0} {1}\nsilver sphere m 0 0 4 {0} 0 0 {1}\n"
        "gray ring g 0 0 8 0 0 {2} 0 0 1 0 {3}\n",
        4 * k, k, -2 * k, 16 * k);
  };
  const double expected =
      brightness(Setting(ball(1)).at(V3d(0, 0, 0), Setting(ball(1)).with(Weights::silhouettes, 512)).mean);
  for (const double k : {1. / 1024, 1024.}) {
    const Setting setting(ball(k));
    const double mean = brightness(setting.at(V3d(0, 0, 0), setting.with(Weights::silhouettes, 512)).mean);
    EXPECT_NEAR(mean / expected, 1, .01) << k;
  }
}

// Under an even sky of 1 a convex object of chrome shows .9 wherever it is seen.
double meanBeside(const std::string& object, const V3d& point, double* sum = nullptr) {
  const Setting setting(
      "void glow sky 0 0 4 1 1 1 0\nsky source dome 0 0 4 0 0 1 360\nvoid metal chrome 0 0 5 .9 .9 .9 1 0\n" +
      object);
  const SphereEstimator estimator(*setting.transport, setting.with(Weights::silhouettes, 512));
  SphereEstimator::Workspace workspace(estimator);
  const double mean = brightness(estimator.estimate(point, workspace).mean);
  if (sum) *sum = sumOf(workspace.samples);
  return mean;
}

TEST(Estimator, Extremes) {
  struct Case {
    const char* name;
    std::string object;
    V3d point;
    double mean;
  };
  const auto beside = [](double solidAngle) { return 1 - .1 * solidAngle / (4 * kPi); };
  const double quarter = 4 * kPi / 6;  // a square of 2 a side as seen from 1 before its middle
  const auto square = [](double k, const V3d& o) {
    return fmt::format("chrome polygon p 0 0 12 {} {} {} {} {} {} {} {} {} {} {} {}\n", o.x + k, o.y - k,
                       o.z - k, o.x + k, o.y + k, o.z - k, o.x + k, o.y + k, o.z + k, o.x + k, o.y - k,
                       o.z + k);
  };
  const V3d far(1e5, -1e5, 1e5);
  const Case cases[] = {
      {"nothing", "", V3d(1, 2, 3), 1},
      {"square", square(1, V3d(0, 0, 0)), V3d(0, 0, 0), beside(quarter)},
      {"small", square(1e-3, V3d(0, 0, 0)), V3d(0, 0, 0), beside(quarter)},
      {"large", square(1e3, V3d(0, 0, 0)), V3d(0, 0, 0), beside(quarter)},
      {"shifted", square(1, far), far, beside(quarter)},
      {"minute sphere", "chrome sphere s 0 0 4 1000 0 0 1e-6\n", V3d(0, 0, 0), 1},
      {"edge-on", square(1, V3d(0, 0, 0)), V3d(1, -5, 0), 1},
      {"nearly edge-on", square(1, V3d(0, 0, 0)), V3d(1 - 1e-9, -5, 0), 1},
      {"on a mirror", square(1, V3d(0, 0, 0)), V3d(1, .2, .3), 1},
      // Metals mirror more at grazing angles.
      {"just before a mirror", square(1, V3d(0, 0, 0)), V3d(1 - 1e-5, .2, .3), .958},
      // What lies inside sees nothing.
      {"on a sphere", "chrome sphere s 0 0 4 0 0 0 1\n", V3d(0, 0, 1), .5},
      // Twice around is no more than outside.
      {"wound twice", "chrome polygon p 0 0 24 1 -1 -1 1 1 -1 1 1 1 1 -1 1 1 -1 -1 1 1 -1 1 1 1 1 -1 1\n",
       V3d(0, 0, 0), 1},
  };
  for (const Case& c : cases) {
    double sum = 0;
    EXPECT_NEAR(meanBeside(c.object, c.point, &sum), c.mean, .001) << c.name;
    EXPECT_NEAR(sum, 4 * kPi, 1e-9) << c.name;
  }
  double sum = 0;
  EXPECT_TRUE(std::isfinite(meanBeside("chrome bubble s 0 0 4 0 0 0 1\n", V3d(.1, .2, .3), &sum)));
  EXPECT_NEAR(sum, 4 * kPi, 1e-9) << "inside a sphere";
}

TEST(Estimator, AloneInUniformLight) {
  const Setting setting("void glow sky 0 0 4 1 1 1 0\nsky source dome 0 0 4 0 0 1 360\n");
  for (const Weights weights : kAllWeights) {
    const PointAnswer a = setting.at(V3d(1, 2, 3), setting.with(weights, 2048));
    EXPECT_NEAR(brightness(a.mean), 1, 1e-9);
    EXPECT_NEAR(brightness(a.scalarIrradiance), kPi, 1e-8);
    EXPECT_NEAR(brightness(a.cylindricalIrradiance), kPi, 2e-3 * kPi);
    for (const Irradiance& facing : a.facing) EXPECT_NEAR(brightness(facing), kPi, 5e-3 * kPi);
    EXPECT_NEAR(a.lightVector.length(), 0, .02);
  }
}

TEST(Estimator, UnderHalfASphereOfLight) {
  const Setting setting("void glow sky 0 0 4 1 1 1 0\nsky source dome 0 0 4 0 0 1 180\n");
  for (const Weights weights : kAllWeights) {
    const PointAnswer a = setting.at(V3d(0, 0, 0), setting.with(weights, 2048));
    EXPECT_NEAR(brightness(a.mean), .5, 2e-3);
    EXPECT_NEAR(brightness(a.scalarIrradiance), kPi / 2, 5e-3);
    EXPECT_NEAR(brightness(a.cylindricalIrradiance), kPi / 2, .01);
    for (int face = 0; face < 4; ++face) EXPECT_NEAR(brightness(a.facing[face]), kPi / 2, .02);
    EXPECT_NEAR(brightness(a.facing[4]), kPi, .02);
    EXPECT_NEAR(brightness(a.facing[5]), 0, 2e-3);
    EXPECT_NEAR((a.lightVector - V3d(0, 0, kPi)).length(), 0, .02);
  }
}

// Where the channels are the same, so are the errors; where they have nothing to do with each other, that of
// luminance is less than the channels' errors weighted alike.
TEST(Estimator, StandardErrorOfLuminanceIsItsOwn) {
  const Setting grey(
      "void light lamp 0 0 3 5 5 5\nvoid mirror silver 0 0 3 .9 .9 .9\n"
      "void plastic gray 0 0 5 .5 .5 .5 0 0\nlamp ring l 0 0 8 0 0 3 0 0 -1 0 .5\n"
      "silver sphere m 0 0 4 2 0 1 .5\ngray ring g 0 0 8 0 0 0 0 0 1 0 9\n");
  const Setting redAndGreen(
      "void glow red 0 0 4 1 0 0 0\nred source east 0 0 4 1 0 0 180\n"
      "void glow green 0 0 4 0 1 0 0\n"
      "green polygon north 0 0 12 -1e6 1 -1e6 -.5 1 -1e6 -.5 1 1e6 -1e6 1 1e6\n");
  for (const Weights weights : kAllWeights) {
    const SphereEstimator estimator(*grey.transport, grey.with(weights, 512), true);
    SphereEstimator::Workspace workspace(estimator);
    const PointAnswer a = estimator.estimate(V3d(.2, .4, 1.5), workspace);
    EXPECT_GT(a.brightnessError, 0);
    EXPECT_NEAR(a.brightnessError / a.standardError.color.y, 1, 1e-6) << static_cast<int>(weights);

    const SphereEstimator apart(*redAndGreen.transport, redAndGreen.with(weights, 512), true);
    SphereEstimator::Workspace other(apart);
    const PointAnswer b = apart.estimate(V3d(0, 0, 0), other);
    EXPECT_GT(b.standardError.color.x, 0);
    EXPECT_GT(b.standardError.color.y, 0);
    const double independent =
        std::hypot(kRedWeight * b.standardError.color.x, kGreenWeight * b.standardError.color.y);
    EXPECT_NEAR(b.brightnessError / independent, 1, .15) << static_cast<int>(weights);
    EXPECT_LT(b.brightnessError, .85 * std::sqrt(brightness(b.standardError.color * b.standardError.color)));
  }
}

// Radiance L, radius a: intensity I = pi a^2 L, and the mean is L times its share of the sphere.
TEST(Estimator, LampAloneInSpace) {
  const double radiance = 100, radius = .1, intensity = kPi * radius * radius * radiance;
  const Setting setting("void light lamp 0 0 3 100 100 100\nlamp sphere l 0 0 4 0 0 0 .1\n");
  for (const double distance : {.2, 1., 5., 100.}) {
    const V3d point = distance * V3d(1, 2, 2) / 3;
    const PointAnswer a = setting.at(point, setting.with(Weights::silhouettes, 512));
    const double sine = radius / distance;
    const double exact = radiance * sine * sine / (1 + std::sqrt(1 - sine * sine)) / 2;
    EXPECT_NEAR(brightness(a.mean) / exact, 1, 1e-6) << distance;
    EXPECT_NEAR(brightness(a.mean) / (intensity / (4 * kPi * distance * distance)), 1, sine * sine)
        << distance;
    // What faces it, pi L sin^2. One ray stands for all of a sphere: the vector is that much too long.
    EXPECT_NEAR(a.lightVector.length() / (kPi * radiance * sine * sine), 1, .3 * sine * sine) << distance;
  }
}

// Thick glass with two parallel faces refracts rays into and out of it, but the sun is seen in its own
// direction. Light that is reflected within the glass an even number of times arrives with the rest: 2 n /
// (n^2 + 1) of all at normal incidence.
TEST(Estimator, SeesTheSunThroughThickGlass) {
  constexpr double kIndex = 1.5, kRadiance = 1e6;
  std::string text = fmt::format("void dielectric glass 0 0 5 1 1 1 {} 0\n", kIndex);
  text +=
      "glass polygon below 0 0 12 -9 -9 1 -9 9 1 9 9 1 9 -9 1\n"
      "glass polygon above 0 0 12 -9 -9 1.1 9 -9 1.1 9 9 1.1 -9 9 1.1\n";
  text += "void light sunlight 0 0 3 1e6 1e6 1e6\nsunlight source sun 0 0 4 0 0 1 .5\n";
  const Setting setting(text);
  const double share = (1 - std::cos(.25 * kPi / 180)) / 2, passes = 2 * kIndex / (kIndex * kIndex + 1);
  for (const uint64_t rotation : {1, 2, 3}) {
    const PointAnswer a = setting.at(V3d(.1, .2, 0), setting.with(Weights::silhouettes, 512, rotation));
    EXPECT_NEAR(brightness(a.mean) / (kRadiance * share * passes), 1, .01);
  }
}

// A room that light enters through a window of a twelfth of its south wall.
std::string daylitRoom() {
  return "void plastic gray 0 0 5 .5 .5 .5 0 0\nvoid glass clear 0 0 3 .96 .96 .96\n"
         "void glow sky_glow 0 0 4 1 1 1 0\nsky_glow source sky 0 0 4 0 0 1 360\n"
         "gray polygon floor 0 0 12 0 0 0 4 0 0 4 6 0 0 6 0\n"
         "gray polygon roof 0 0 12 0 0 3 0 6 3 4 6 3 4 0 3\n"
         "gray polygon west 0 0 12 0 0 0 0 6 0 0 6 3 0 0 3\n"
         "gray polygon east 0 0 12 4 0 0 4 0 3 4 6 3 4 6 0\n"
         "gray polygon north 0 0 12 0 6 0 4 6 0 4 6 3 0 6 3\n"
         "gray polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1 0 1 1 0 2 2 0 2 2 0 1 1 0 1\n"
         "clear polygon window 0 0 12 1 0 1 2 0 1 2 0 2 1 0 2\n";
}

// With -aa above 0, light comes from the patches of the coarse solution, which other patches share, so that
// each sample needs a transport of its own.
TEST(Estimator, PatchesGiveTheMeanOfPathsWithLessNoise) {
  const V3d point(2.5, 4, 1.2);
  const auto means = [&](double accuracy, int count, double& stated) {
    Sample sample;
    stated = 0;
    for (int i = 0; i < count; ++i) {
      const SphereSetting setting(sceneOf(daylitRoom()), [&](RayOptions& o) {
        o.ambientBounces = 2;
        o.ambientAccuracy = accuracy;
        o.rotation = static_cast<uint64_t>(i + 1);
        o.leastForPatches = 128;
        o.directJitter = .9;  // leaves only paths from the eye
      });
      SphereOptions options = setting.options.sphere;
      options.baseDirections = 256;
      options.rotation = static_cast<uint64_t>(i + 1);
      const SphereEstimator estimator(*setting.transport, options, true);
      SphereEstimator::Workspace workspace(estimator);
      const PointAnswer a = estimator.estimate(point, workspace);
      sample.add(brightness(a.mean));
      stated += a.brightnessError * a.brightnessError / count;
    }
    return sample;
  };
  double statedOfPaths = 0, statedOfPatches = 0;
  const int count = 24;
  const Sample paths = means(0, count, statedOfPaths), patches = means(.1, count, statedOfPatches);
  const double error = std::hypot(paths.standardError(), patches.standardError());
  EXPECT_LT(std::abs(paths.mean() - patches.mean()), 3 * error + .005 * paths.mean())
      << paths.mean() << " and " << patches.mean();
  EXPECT_LT(3 * error, .045 * paths.mean()) << "would not see an error of 5%";
  EXPECT_LT(patches.standardError(), .8 * paths.standardError());
  const double trueToStated = patches.standardError() * std::sqrt(count / statedOfPatches);
  // With few directions and no noise of paths, the stated error takes bends of smooth light for noise.
  EXPECT_GT(trueToStated, .4);
  EXPECT_LT(trueToStated, 1.25);
}

// By lamps, light vertices take the place of the coarse solution: -aa changes nothing, and no patches are
// made. The glass in the window is known, and a sky is not.
TEST(Estimator, LightVerticesTakeThePlaceOfPatches) {
  const std::string lamp = "void light l 0 0 3 9 9 9\nl sphere lamp 0 0 4 1.5 1.5 1.5 .1\n",
                    closed =
                        "void plastic gray 0 0 5 .5 .5 .5 .04 .1\n"
                        "gray bubble hall 0 0 4 2 2 1 3\n" +
                        lamp,
                    byDay = daylitRoom() + lamp;
  std::string byNight = byDay;
  byNight.erase(byNight.find("sky_glow source"),
                byNight.find("gray polygon floor") - byNight.find("sky_glow source"));
  const auto answerOf = [](const std::string& text, double accuracy, size_t& patches) {
    const SphereSetting setting(sceneOf(text), [&](RayOptions& o) {
      o.ambientBounces = 3;
      o.ambientAccuracy = accuracy;
      o.leastForPatches = 128;
    });
    SphereOptions options = setting.options.sphere;
    options.baseDirections = 256;
    const SphereEstimator estimator(*setting.transport, options, true);
    SphereEstimator::Workspace workspace(estimator);
    const PointAnswer a = estimator.estimate(V3d(2.3, 2, 1.2), workspace);
    const CoarseSolution* const coarse = setting.transport->caches().coarse.get();
    EXPECT_EQ(coarse != nullptr, accuracy > 0);
    patches = coarse ? coarse->patches() : 0;
    return std::array{a.mean.color.x, a.standardError.color.x, a.brightnessError};
  };
  size_t patches = 0;
  for (const std::string& scene : {closed, byNight}) {
    const auto without = answerOf(scene, 0, patches);
    EXPECT_GT(without[0], 0);
    EXPECT_EQ(answerOf(scene, .1, patches), without);
    EXPECT_EQ(patches, 0U);
  }
  const auto without = answerOf(byDay, 0, patches);
  EXPECT_NE(answerOf(byDay, .1, patches), without) << "by daylight, patches are used";
  EXPECT_GT(patches, 0U);
}

// The sun lights a patch of the floor, and nothing else is bright. Where no light is reflected twice,
// directions are sent to the patch as they are for paths.
TEST(Estimator, FindsSunlitPatchesWithoutBounces) {
  const SphereSetting room(
      sceneOf(daylitRoom() + "void light glare 0 0 3 1e5 1e5 1e5\nglare source sun 0 0 4 0 -1 1 .53\n"),
      [](RayOptions& o) { o.ambientBounces = 0; });
  const auto means = [&](Weights weights) {
    SphereOptions options = room.options.sphere;
    options.baseDirections = 128;
    options.weights = weights;
    Sample sample;
    for (uint64_t rotation = 1; rotation <= 40; ++rotation) {
      options.rotation = rotation;
      const SphereEstimator estimator(*room.transport, options, true);
      SphereEstimator::Workspace workspace(estimator);
      sample.add(brightness(estimator.estimate(V3d(2.5, 4, 1.2), workspace).mean));
    }
    return sample;
  };
  const Sample aimed = means(Weights::silhouettes), even = means(Weights::homogeneous);
  EXPECT_LT(std::abs(aimed.mean() - even.mean()), 4 * even.standardError());
  const auto spread = [](const Sample& s) { return s.standardError() * std::sqrt(40.) / s.mean(); };
  EXPECT_LT(spread(aimed), .1);
  EXPECT_GT(spread(even), .3) << "would not see that nothing was aimed";
}

}  // namespace
}  // namespace rsphere
