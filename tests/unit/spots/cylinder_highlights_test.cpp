#include "spots/cylinder_highlights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/frame.h"
#include "tests/unit/spots/highlight_scene.h"
#include "tests/unit/transport/transport_fixture.h"
#include "transport/gather_directions.h"

namespace rsphere {
namespace {
namespace on_cylinders {

using namespace highlight_scene;

const std::string kLeg = "chrome cylinder leg 0 0 7 2 2 .1 2 2 .9 .02\n";

// A cylinder upright, askew or lying, with sources of several kinds.
std::vector<std::string> lit() {
  std::vector<std::string> texts;
  for (const char* leg :
       {"chrome cylinder leg 0 0 7 2 2 .1 2 2 .9 .02\n", "chrome tube leg 0 0 7 2.2 1.9 .3 1.8 2 .7 .03\n",
        "chrome cylinder leg 0 0 7 1.5 2 .5 2.5 2 .5 .05\n"})
    for (const char* source : {"lamp sphere s 0 0 4 3 2.5 2.5 .2\n",
                               "lamp polygon s 0 0 12 2 2 1.6 2 2.3 1.6 2.5 2.3 1.6 2.5 2 1.6\n",
                               "lamp cylinder s 0 0 7 1 3 2 3 3 2 .02\n", "lamp source s 0 0 4 1 1 1 5\n",
                               "lamp sphere s 0 0 4 3 2.5 2.5 .2\nlamp sphere t 0 0 4 1 2.5 2.5 .2\n"})
      texts.push_back(kMaterials + leg + source);
  return texts;
}

const std::vector<V3d> kPoints = {V3d(2.3, 2.2, 0), V3d(2, 2.12, .5), V3d(3, .5, 1), V3d(0, 3.9, .2)};

const V3d kCenter(2, 2, .5);  // of all cylinders

const Cone& cylinderIn(const Traced& t) {
  for (const Surface& surface : t.scene().outermost())
    if (t.scene().surfaceName(surface) == "leg") return *surface.shape.as<Cone>();
  throw std::logic_error("no leg");
}

// A uniform place on a cylinder; what a direction from a point to it stands for (sr), 0 on the far side.
struct Place {
  V3d direction;
  double solidAngle;

  Place(const Cone& cylinder, const V3d& point, Random& random) {
    const auto [x, y] = frame(cylinder.axis);
    const double angle = 2 * std::numbers::pi * random.uniform();
    const V3d normal = std::cos(angle) * x + std::sin(angle) * y;
    const V3d way = cylinder.base + random.uniform() * cylinder.length * cylinder.axis +
                    cylinder.radius0 * normal - point;
    const double area = 2 * std::numbers::pi * cylinder.radius0 * cylinder.length;
    direction = way.normalized();
    solidAngle = area * std::max(0., -normal.dot(direction)) / way.length2();
  }
};

// The density of aimed directions is density(): the integral of a function over the cylinder, weighted with
// this density, agrees with the mean over sampled directions.
TEST(CylinderHighlights, AreAimedAtAsDensitySays) {
  int aimedAt = 0;
  double differences = 0, squares = 0, total = 0;
  for (const std::string& text : lit()) {
    const Traced t(text);
    const CylinderHighlights highlights = highlightsOf<CylinderHighlights>(t);
    Sample sampled, weighted;
    for (const V3d& point : kPoints) {
      const V3d middle = (kCenter - point).normalized();
      CylinderHighlights::Aim aim;
      highlights.aim(point, middle, 0, aim);
      if (!(aim.mean > 0)) continue;
      ++aimedAt;
      Random random(1);
      const auto [x, y] = frame(middle);
      const auto some = [x = x, y = y](const V3d& d) { return 2 + d.dot(x) + .5 * d.dot(y); };
      for (int i = 0; i < 6000; ++i) {
        const V3d d = highlights.sample(aim, random.uniform(), random.uniform(), random.uniform());
        const bool meets = d.length2() > 0;
        if (meets) {
          EXPECT_NEAR(d.length(), 1, 1e-12);
          EXPECT_GT(highlights.density(aim, d), 0);
        }
        sampled.add(meets ? some(d) : 0);
      }
      for (int i = 0; i < 400000; ++i) {
        const Place place(cylinderIn(t), point, random);
        weighted.add(place.solidAngle > 0
                         ? highlights.density(aim, place.direction) * place.solidAngle * some(place.direction)
                         : 0);
      }
    }
    if (sampled.count() == 0) continue;
    EXPECT_GT(sampled.mean(), .3) << text;
    const double error = std::hypot(sampled.standardError(), weighted.standardError());
    EXPECT_LT(std::abs(sampled.mean() - weighted.mean()), kMostSigmas * error) << text;
    EXPECT_GT(std::abs(1.5 * sampled.mean() - weighted.mean()), kMostSigmas * error) << text;
    differences += sampled.mean() - weighted.mean();
    squares += error * error;
    total += sampled.mean();
  }
  EXPECT_GE(aimedAt, 40);
  EXPECT_LT(std::abs(differences), kMostSigmas * std::sqrt(squares));
  EXPECT_GT(std::abs(.05 * total + differences), kMostSigmas * std::sqrt(squares)) << "the spoiled twin";
}

// Aimed directions find nearly all light that the cylinder sends to the point, and about as much as is
// expected.
TEST(CylinderHighlights, AreWhereTheCylinderShowsTheSource) {
  int seen = 0;
  for (const std::string& text : lit()) {
    Traced t(text, unbiased());
    const CylinderHighlights highlights = highlightsOf<CylinderHighlights>(t);
    for (const V3d& point : kPoints) {
      const V3d middle = (kCenter - point).normalized();
      CylinderHighlights::Aim aim;
      highlights.aim(point, middle, 0, aim);
      Random random(2);
      Sample all;
      for (int i = 0; i < 100000; ++i) {
        const Place place(cylinderIn(t), point, random);
        const double factor = place.solidAngle * place.direction.dot(middle) / std::numbers::pi;
        all.add(factor > 0 ? t.value(point, place.direction, mixBits(i)) * factor : 0);
      }
      // Elsewhere, the edges of highlights beyond the ends of the cylinder are seen, or nothing.
      if (!(std::max(all.mean(), aim.mean) > 1e-3)) continue;
      ++seen;
      ASSERT_GT(aim.mean, 0) << text << point << all.mean();
      Sample aimed;
      for (int i = 0; i < 6000; ++i) {
        const V3d d = highlights.sample(aim, random.uniform(), random.uniform(), random.uniform());
        const double factor =
            d.length2() > 0 ? d.dot(middle) / (highlights.density(aim, d) * std::numbers::pi) : 0;
        aimed.add(factor > 0 ? t.value(point, d, mixBits(i)) * factor : 0);
      }
      const double error = std::hypot(aimed.standardError(), all.standardError());
      EXPECT_GT(aimed.mean(), .9 * all.mean() - kMostSigmas * error) << text << point;
      EXPECT_LT(aimed.mean(), all.mean() + kMostSigmas * error) << text << point;
      EXPECT_GT(aim.mean, .65 * all.mean() - kMostSigmas * error) << text << point;
      EXPECT_LT(aim.mean, 1.5 * all.mean() + kMostSigmas * error) << text << point;
      EXPECT_LT(aimed.standardError(), 1.1 * all.standardError())
          << text << point << " with 1/16 of the rays";
    }
  }
  EXPECT_GE(seen, 30);
}

TEST(CylinderHighlights, AreOnRoughCylindersThatSeeSources) {
  const auto none = [](const std::string& text) {
    return highlightsOf<CylinderHighlights>(Traced(kMaterials + text)).empty();
  };
  EXPECT_FALSE(none(kLeg + kBulb));
  EXPECT_FALSE(none("chrome tube leg 0 0 7 2 2 .1 2 2 .9 .02\n" + kBulb));
  EXPECT_FALSE(none("glossy cylinder leg 0 0 7 2 2 .1 2 2 .9 .02\n" + kBulb));
  EXPECT_TRUE(none("mirroring cylinder leg 0 0 7 2 2 .1 2 2 .9 .02\n" + kBulb)) << "smooth";
  EXPECT_TRUE(none("matt cylinder leg 0 0 7 2 2 .1 2 2 .9 .02\n" + kBulb));
  EXPECT_TRUE(none("chrome cone leg 0 0 8 2 2 .1 2 2 .9 .02 .01\n" + kBulb));
  EXPECT_TRUE(none(kLeg)) << "no source";
  EXPECT_TRUE(none(kLeg + kBulb + "matt sphere pot 0 0 4 3 2.5 2.5 .3\n")) << "hidden";
  EXPECT_TRUE(none(kLeg + "lamp polygon away 0 0 12 2 2 3 3 2 3 3 3 3 2 3 3\n")) << "faces away";
  EXPECT_TRUE(none(kLeg + "lamp source above 0 0 4 0 0 1 1\n")) << "lengthwise";
  EXPECT_TRUE(none(""));
}

TEST(CylinderHighlights, AreAimedAtWhereTheyMatter) {
  expectAimedWhereTheyMatter(highlightsOf<CylinderHighlights>(Traced(kMaterials + kLeg + kBulb)),
                             V3d(2.3, 2.2, 0));
}

// Beside a cylinder, and beside a cylinder and a ball.
TEST(CylinderHighlights, LeaveTheMeanOfPathsAsItIs) {
  for (const std::string ball : {"", "chrome sphere ball 0 0 4 1.9 2.3 .1 .03\n"})
    expectMeanOfPathsKept(kLeg + ball, V3d(2.3, 2.2, .2), 3000);
}

}  // namespace on_cylinders
}  // namespace
}  // namespace rsphere
