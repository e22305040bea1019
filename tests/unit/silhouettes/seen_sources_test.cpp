#include "silhouettes/seen_sources.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::seen_sources_test {
namespace {

// Radiance 100; a mirror that reflects 90%.
constexpr const char* kMaterials =
    "void light lamp 0 0 3 100 100 100\nvoid mirror silver 0 0 3 .9 .9 .9\nvoid plastic black 0 0 5 0 0 0 0 "
    "0\n"
    "void glass pane 0 0 3 .96 .96 .96\n";

struct Setting : SphereSetting {
  explicit Setting(const std::string& text) : SphereSetting(sceneOf(kMaterials + text)) {}
  double at(const V3d& point, Weights weights, int base, uint64_t rotation = 0,
            std::vector<DirectionSample>* samples = nullptr) const {
    SphereOptions o = options.sphere;
    o.weights = weights;
    o.baseDirections = base;
    o.mostDirections = 2 * base;
    o.rotation = rotation;
    const SphereEstimator estimator(*transport, o);
    SphereEstimator::Workspace workspace(estimator);
    const double mean = brightness(estimator.estimate(point, workspace).mean);
    if (samples) *samples = workspace.samples;
    return mean;
  }
  double apart(const V3d& point, int base = 256, uint64_t rotation = 0) const {
    return at(point, Weights::silhouettes, base, rotation);
  }
};

double capOf(double radius, double distance) {
  const double sine = radius / distance;
  return 2 * kPi * sine * sine / (1 + std::sqrt(1 - sine * sine));
}

constexpr const char* kWall = "silver polygon wall 0 0 12 0 -9 -9 0 9 -9 0 9 9 0 -9 9\n";

TEST(SeenSources, SphereAndItsImageInAMirror) {
  const Setting setting(std::string(kWall) + "lamp sphere l 0 0 4 1 1 0 .1\n");
  const V3d point(2, 0, .3);
  const double straight = (point - V3d(1, 1, 0)).length(), mirrored = (point - V3d(-1, 1, 0)).length();
  const double exact = 100 * (capOf(.1, straight) + .9 * capOf(.1, mirrored)) / (4 * kPi);
  EXPECT_NEAR(setting.apart(point) / exact, 1, 1e-9);
}

// What shadow rays do not pass and others do: nothing is sent to the lamp behind it, and it counts where
// directions meet it.
TEST(SeenSources, SphereBehindAPrismThatTurnsNothing) {
  const Setting setting(
      "void prism1 film 5 .6 Dx Dy Dz . 0 0\nfilm bubble b 0 0 4 0 0 3 1\nlamp sphere l 0 0 4 0 0 3 .5\n");
  const double exact = 100 * .6 * capOf(.5, 3) / (4 * kPi);
  Sample found;
  for (uint64_t rotation = 0; rotation < 8; ++rotation)
    found.add(setting.apart(V3d(0, 0, 0), 4096, rotation));
  expectMean(found, exact, .5);
}

TEST(SeenSources, SphereBehindABackThatIsNotSeen) {
  Setting setting("lamp polygon back 0 0 12 -2 -2 1 2 -2 1 2 2 1 -2 2 1\nlamp sphere l 0 0 4 0 0 3 .5\n");
  setting.options.ray.backFacesVisible = false;
  setting.transport = std::make_unique<Transport>(setting.scene, setting.options.ray, IrradianceAt::none);
  Sample found;
  for (uint64_t rotation = 0; rotation < 8; ++rotation)
    found.add(setting.apart(V3d(0, 0, 0), 4096, rotation));
  expectMean(found, 100 * capOf(.5, 3) / (4 * kPi), .5);
}

// Half of the lamp's image lies beyond the mirror's edge, y = 1 as seen from this point.
TEST(SeenSources, ImageCutByTheMirrorsEdge) {
  const Setting setting(
      "silver polygon wall 0 0 12 0 -9 -9 0 .5 -9 0 .5 9 0 -9 9\nlamp polygon l 0 0 12 1 .5 -.5 1 .5 .5 1 "
      "1.5 .5 1 1.5 "
      "-.5\nlamp polygon l 0 0 12 1 1.5 -.5 1 1.5 .5 1 .5 .5 1 .5 -.5\n");
  const V3d point(1.5, 0, 0);
  const std::vector<V3d> lamp{V3d(-1, .5, -.5), V3d(-1, .5, .5), V3d(-1, 1.5, .5), V3d(-1, 1.5, -.5)};
  const std::vector<V3d> cut{V3d(-1, .5, -.5), V3d(-1, .5, .5), V3d(-1, 5. / 6, .5), V3d(-1, 5. / 6, -.5)};
  const std::vector<V3d> front{V3d(1, .5, -.5), V3d(1, .5, .5), V3d(1, 1.5, .5), V3d(1, 1.5, -.5)};
  const double exact =
      100 * (polygonSolidAngle(front, point) + .9 * polygonSolidAngle(cut, point)) / (4 * kPi);
  EXPECT_NEAR(setting.apart(point) / exact, 1, 1e-9);
  const double whole =
      100 * (polygonSolidAngle(front, point) + .9 * polygonSolidAngle(lamp, point)) / (4 * kPi);
  EXPECT_GT(std::abs(setting.apart(point) / whole - 1), .1);
}

TEST(SeenSources, SunAndItsImageInAPane) {
  const Setting setting(
      "lamp source sun 0 0 4 1 0 1 .5\npane polygon p 0 0 12 0 -9 -9 0 9 -9 0 9 9 0 -9 9\n");
  const double solidAngle = 4 * kPi * std::pow(std::sin(.25 * kPi / 360), 2);
  const V3d point(2, 0, 0);
  // Through nothing; and at 45 degrees in glass, what a single ray there shows.
  PathTracer tracer = setting.transport->pathTracer();
  const TracedRay ray = tracer.trace(point, V3d(-1, 0, 1).normalized(), 0, 1);
  const double glass = brightness(ray.value);
  EXPECT_GT(glass, 5);
  EXPECT_EQ(ray.shown.mirror, SurfaceId(1));
  // The glass has no other light to mirror or let pass.
  const double exact = (100 + glass) * solidAngle / (4 * kPi);
  EXPECT_NEAR(setting.apart(point) / exact, 1, 1e-4);
}

// A direction to the faint image of a lamp in a pane also shows what is behind the pane. Where one point in
// five has such a direction, with five times the weight, the bright surroundings are as noisy.
TEST(SeenSources, FaintImageBeforeBrightSurroundings) {
  const Setting setting(
      "void glow sky 0 0 4 30 30 30 0\nsky bubble around 0 0 4 0 0 0 50\n"
      "void light sun 0 0 3 2e7 2e7 2e7\nsun source s 0 0 4 1 1 1 .5\n"
      "pane polygon p 0 0 12 0 -9 -9 0 9 -9 0 9 9 0 -9 9\n"
      "lamp polygon l 0 0 12 2 -.2 1.5 2 .2 1.5 3.2 .2 1.5 3.2 -.2 1.5\n");
  Sample answers;
  for (uint64_t k = 0; k < 32; ++k) answers.add(setting.apart(V3d(.3, 0, 0), 2048, k));
  EXPECT_LT(answers.standardError() / answers.mean(), 1.5e-5);
}

TEST(SeenSources, SolidAnglesSumToTheSphere) {
  const Setting setting(std::string(kWall) +
                        "lamp sphere l 0 0 4 1 1 0 .1\nlamp ring r 0 0 8 2 0 2 1 1 -1 0 .5\n"
                        "lamp cylinder c 0 0 7 3 -2 0 3 -2 1.2 .02\nlamp source s 0 0 4 1 1 1 .5\n"
                        "pane polygon p 0 0 12 4 -9 -9 4 9 -9 4 9 9 4 -9 9\n");
  std::vector<DirectionSample> samples;
  for (const double x : {.1, 1.5, 2.5, 3.9}) {
    setting.at(V3d(x, 0, 0), Weights::silhouettes, 300, 0, &samples);
    double sum = 0;
    for (const DirectionSample& s : samples) sum += s.solidAngle;
    EXPECT_NEAR(sum, 4 * kPi, 1e-9) << x;
  }
}

// Against brute force: rings, tubes, concave polygons and ones that wind twice; tilted, near,
// mirrored.
TEST(SeenSources, EveryShapeOfSource) {
  const char* shapes[] = {
      "lamp ring r 0 0 8 2 0 2 1 1 -1 0 .5\n",
      "lamp ring r 0 0 8 1 .3 .5 -.2 0 -1 0 .5\n",
      "lamp cylinder c 0 0 7 3 -2 0 1 -2 1.2 .1\n",
      "lamp polygon p 0 0 18 3 -1 -1 3 -1 1 3 0 1 3 .2 .2 3 1 0 3 1 -1\n",
      "lamp polygon p 0 0 27 3 -1 -1 3 -1 1 3 1 1 3 1 -1 3 -1 -1 3 .2 .2 3 .2 .8 3 .8 .8 3 .8 .2\n",
      "lamp polygon p 0 0 9 1.3 -1 -1 1.3 -1 1 1.3 2 1\n"};
  for (const char* shape : shapes) {
    const Setting setting(std::string(kWall) + shape);
    const V3d point(.5, 0, 0);
    Sample apart, equal;
    for (uint64_t rotation = 0; rotation < 16; ++rotation) apart.add(setting.apart(point, 256, rotation));
    for (uint64_t rotation = 0; rotation < 8; ++rotation)
      equal.add(setting.at(point, Weights::homogeneous, 40000, rotation));
    const double error = std::hypot(apart.standardError(), equal.standardError());
    EXPECT_GT(equal.mean(), 0) << shape;
    EXPECT_LT(std::abs(apart.mean() - equal.mean()), kMostSigmas * error)
        << shape << apart.mean() << ' ' << equal.mean();
    EXPECT_GT(std::abs(1.1 * apart.mean() - equal.mean()), kMostSigmas * error) << shape;
    EXPECT_LT(apart.standardError() / apart.mean(), .01) << shape;
  }
}

// The number of rays to the first image at the origin if `most` are to be divided.
double raysTo(const char* sources, size_t most) {
  const Setting setting(sources);
  const std::vector<SeenSources::Image> images =
      SeenSources(setting.transport->prepared()).findImages(V3d(0, 0, 0), most, 0);
  return images.empty() ? 0 : images[0].rays;
}

TEST(SeenSources, MoreDirectionsMeanMoreRaysToASmallLamp) {
  const char* lamp = "lamp sphere l 0 0 4 0 0 3 .1\n";
  EXPECT_NEAR(raysTo(lamp, 64), 16, 1);
  EXPECT_GT(raysTo(lamp, 4096), 400) << "with 16 the error of a half hidden lamp would not fall";
  EXPECT_LT(raysTo(lamp, 4096), 700) << "it needs fewer than all";
}

TEST(SeenSources, WideSourcesGetAllRays) {
  const char* ceiling = "lamp polygon l 0 0 12 -3 -3 2.5 -3 3 2.5 3 3 2.5 3 -3 2.5\n";
  EXPECT_NEAR(raysTo(ceiling, 512), 512, 1) << "64 would leave six times the error behind objects";
  const double solidAngle = capOf(.4, 3);
  EXPECT_NEAR(raysTo("lamp sphere l 0 0 4 0 0 3 .4\n", 512), solidAngle / (4 * kPi / 2048 / 16), 1)
      << "as many as sixteen for each cell of 2048 directions";
}

TEST(SeenSources, DistantSourcesOfAnyWidthAreIntegratedSeparately) {
  for (const double width : {4., 30., 120., 180., 250.}) {
    const Setting setting(fmt::format("lamp source sky 0 0 4 0 0 1 {}\n", width));
    const double exact = 100 * (1 - std::cos(width * kPi / 360)) / 2;
    EXPECT_NEAR(setting.apart(V3d(0, 0, 0)) / exact, 1, 1e-9) << width;
  }
}

// A lamp, a sun: one ray would see all of it or nothing, and scatter as much as the mean.
TEST(SeenSources, HalfHidden) {
  const char* cover = "black polygon b 0 0 12 1 0 -9 1 9 -9 1 9 9 1 0 9\n";
  for (const char* source : {"lamp sphere l 0 0 4 4 0 0 .05\n", "lamp source s 0 0 4 1 0 0 .5\n"}) {
    const Setting setting(std::string(cover) + source);
    const double whole = Setting(source).apart(V3d(0, 0, 0));
    Sample share, square;
    for (uint64_t rotation = 0; rotation < 64; ++rotation) {
      const double seen = setting.apart(V3d(0, 0, 0), 256, rotation) / whole;
      share.add(seen);
      square.add((seen - .5) * (seen - .5));
    }
    expectMean(share, .5, 1.1);
    EXPECT_LT(std::sqrt(square.mean()), .1) << source << ": one ray's is 0.5";
  }
}

}  // namespace
}  // namespace rsphere::seen_sources_test
