#include "spots/ball_highlights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/spots/highlight_scene.h"
#include "tests/unit/transport/transport_fixture.h"
#include "transport/gather_directions.h"

namespace rsphere {
namespace {

using namespace highlight_scene;

const std::string kBall = "chrome sphere ball 0 0 4 2 2 .5 .1\n";

// A ball with a source of each kind, at different distances.
std::vector<std::string> lit() {
  std::vector<std::string> texts;
  for (const char* source : {"lamp sphere s 0 0 4 3 2.5 2.5 .2\n",
                             "lamp polygon s 0 0 12 2 2 1.2 2 2.3 1.2 2.5 2.3 1.2 2.5 2 1.2\n",
                             "lamp ring s 0 0 8 3 1 2 -.5 .5 -1 0 .2\n",
                             "lamp cylinder s 0 0 7 1 3 2 3 3 2 .02\n", "lamp source s 0 0 4 1 1 1 5\n",
                             "lamp sphere s 0 0 4 3 2.5 2.5 .2\nlamp sphere t 0 0 4 1 2.5 2.5 .2\n"})
    texts.push_back(kMaterials + kBall + source);
  return texts;
}

const std::vector<V3d> kPoints = {V3d(2.3, 2.2, 0), V3d(2, 2.12, .5), V3d(3, .5, 1), V3d(0, 3.9, 2)};

const V3d kCenter(2, 2, .5);  // of the ball

// Uniform directions to a ball's disk, and their density (1/sr).
class ToDisk {
 public:
  ToDisk(const V3d& point, const V3d& center, double radius) : middle_((center - point).normalized()) {
    const double sine = std::min(1., radius / (center - point).length());
    versine_ = 1 - std::sqrt(1 - sine * sine);
    std::tie(x_, y_) = frame(middle_);
  }
  V3d sample(Random& random) const {
    const double z = 1 - versine_ * random.uniform(), angle = 2 * std::numbers::pi * random.uniform();
    const double r = std::sqrt(1 - z * z);
    return r * std::cos(angle) * x_ + r * std::sin(angle) * y_ + z * middle_;
  }
  double density() const { return 1 / (2 * std::numbers::pi * versine_); }
  const V3d& middle() const { return middle_; }

 private:
  V3d middle_, x_, y_;
  double versine_ = 0;
};

// The density of aimed directions is density(): the integral of a function over the ball's disk, weighted
// with this density, agrees with the mean over sampled directions.
TEST(BallHighlights, AreAimedAtAsDensitySays) {
  for (const std::string& text : lit()) {
    const Traced t(text);
    const BallHighlights highlights = highlightsOf<BallHighlights>(t);
    Sample sampled, weighted;
    for (const V3d& point : kPoints) {
      const ToDisk disk(point, kCenter, .1);
      BallHighlights::Aim aim;
      highlights.aim(point, disk.middle(), 0, aim);
      ASSERT_GT(aim.mean, 0) << text;
      Random random(1);
      const auto [x, y] = frame(disk.middle());
      const double wide = .1 / (kCenter - point).length();
      const auto some = [&, x = x, y = y](const V3d& d) { return 2 + (d.dot(x) + .5 * d.dot(y)) / wide; };
      for (int i = 0; i < 6000; ++i) {
        const V3d d = highlights.sample(aim, random.uniform(), random.uniform(), random.uniform());
        const bool meets = d.length2() > 0;
        if (meets) {
          EXPECT_NEAR(d.length(), 1, 1e-12);
          EXPECT_GT(highlights.density(aim, d), 0);
        }
        sampled.add(meets ? some(d) : 0);
      }
      for (int i = 0; i < 100000; ++i) {
        const V3d even = disk.sample(random);
        weighted.add(highlights.density(aim, even) / disk.density() * some(even));
      }
    }
    EXPECT_GT(sampled.mean(), 1) << text;
    const double error = std::hypot(sampled.standardError(), weighted.standardError());
    EXPECT_LT(std::abs(sampled.mean() - weighted.mean()), kMostSigmas * error) << text;
    EXPECT_GT(std::abs(1.15 * sampled.mean() - weighted.mean()), kMostSigmas * error) << text;
  }
}

// Aimed directions find nearly all light that the ball sends to the point, and about as much as is expected.
TEST(BallHighlights, AreWhereTheBallShowsTheSource) {
  int seen = 0;
  for (const std::string& text : lit()) {
    Traced t(text, unbiased());
    const BallHighlights highlights = highlightsOf<BallHighlights>(t);
    for (const V3d& point : kPoints) {
      const ToDisk disk(point, kCenter, .1);
      BallHighlights::Aim aim;
      highlights.aim(point, disk.middle(), 0, aim);
      Random random(2);
      Sample aimed, all;
      for (int i = 0; i < 6000; ++i) {
        const V3d d = highlights.sample(aim, random.uniform(), random.uniform(), random.uniform());
        const double value = d.length2() > 0 ? t.value(point, d, mixBits(i)) / highlights.density(aim, d) : 0;
        aimed.add(value / std::numbers::pi);
      }
      for (int i = 0; i < 100000; ++i)
        all.add(t.value(point, disk.sample(random), mixBits(i)) / disk.density() / std::numbers::pi);
      EXPECT_GT(aimed.mean(), .9 * all.mean() - kMostSigmas * all.standardError()) << text << point;
      EXPECT_LT(aimed.mean(), all.mean() + kMostSigmas * all.standardError()) << text << point;
      // A point that is nearer to the ball than its radius sees a highlight of another size.
      if ((kCenter - point).length() < .2) continue;
      EXPECT_GT(aim.mean, .5 * all.mean()) << text << point;
      EXPECT_LT(aim.mean, 2 * all.mean()) << text << point;
      ++seen;
      EXPECT_LT(aimed.standardError(), all.standardError()) << text << point << " with a tenth of the rays";
    }
  }
  EXPECT_GE(seen, 18);
}

TEST(BallHighlights, AreOnRoughBallsThatSeeSources) {
  const auto none = [](const std::string& text) {
    return highlightsOf<BallHighlights>(Traced(kMaterials + text)).empty();
  };
  EXPECT_FALSE(none(kBall + kBulb));
  EXPECT_FALSE(none("glossy sphere ball 0 0 4 2 2 .5 .1\n" + kBulb));
  EXPECT_TRUE(none("mirroring sphere ball 0 0 4 2 2 .5 .1\n" + kBulb)) << "smooth";
  EXPECT_TRUE(none("matt sphere ball 0 0 4 2 2 .5 .1\n" + kBulb));
  EXPECT_TRUE(none("chrome bubble ball 0 0 4 2 2 .5 .1\n" + kBulb)) << "its front is inside";
  EXPECT_TRUE(none("chrome polygon plate 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n" + kBulb));
  EXPECT_TRUE(none(kBall)) << "no source";
  EXPECT_TRUE(none(kBall + kBulb + "matt sphere pot 0 0 4 3 2.5 2.5 .3\n")) << "hidden";
  EXPECT_TRUE(none(kBall + "lamp polygon away 0 0 12 2 2 3 3 2 3 3 3 3 2 3 3\n")) << "faces away";
  EXPECT_TRUE(none(""));
}

TEST(BallHighlights, AreAimedAtWhereTheyMatter) {
  expectAimedWhereTheyMatter(highlightsOf<BallHighlights>(Traced(kMaterials + kBall + kBulb)),
                             V3d(2.5, 2, 0));
}

TEST(BallHighlights, AreLookedForWithIndirectLightAlone) {
  const std::string scene = kMaterials + kBall + kBulb + kFloor;
  EXPECT_FALSE(Traced(scene, unbiased(0)).transport().aims().of<Highlights>());
  EXPECT_TRUE(Traced(scene, unbiased(1)).transport().aims().of<Highlights>());
  EXPECT_FALSE(Traced(kMaterials + kBulb + kFloor, unbiased(1)).transport().aims().of<Highlights>());
}

// The parts of the directions sum to 1 on average, although some aimed directions miss and are left out.
TEST(BallHighlights, LeaveNoDirectionsOut) {
  const Traced t(kMaterials + kBall + kBulb + kFloor, unbiased(1));
  const V3d point(2.2, 2.1, 0), up(0, 0, 1);
  const Aims aims = t.transport().aims();
  const GatherDirections directions(aims, point, up, up, 64);
  Highlights::Aim aim;
  aims.of<Highlights>()->aim({point, up, 64}, aim);
  for (const int count : {1, 8, 64}) {
    Random random(1);
    Sample sum, aimed;
    for (int i = 0; i < 100000 / count; ++i) {
      double parts = 0;
      int there = 0;
      directions.draw({count, random}, [&](const V3d& direction, double part) {
        parts += part;
        there += aims.of<Highlights>()->density(aim, direction) > 0;
      });
      sum.add(parts);
      aimed.add(static_cast<double>(there) / count);
    }
    expectMean(sum, 1, 1.05);
    EXPECT_GT(aimed.mean(), .01) << "or else none is aimed";
  }
}

TEST(BallHighlights, LeaveTheMeanOfPathsAsItIs) { expectMeanOfPathsKept(kBall, V3d(1.5, 2, .2), 2000); }

}  // namespace
}  // namespace rsphere
