// Light of sources in rough highlights, divided between shadow rays and samples of the lobe.
#include "rays/shared_highlights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// A brushed wall that stands on a luminous table of 1 x 1 m, behind a pane or not.
std::string wallOn(const std::string& material, bool pane) {
  std::string text = material +
                     "void light shining 0 0 3 1 1 1\nshining polygon table 0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\n"
                     "wall polygon upright 0 0 12 0 .5 .001 1 .5 .001 1 .5 .5 0 .5 .5\n";
  if (pane)
    text +=
        "void glass clear 0 0 3 .9 .9 .9\n"
        "clear polygon cover 0 0 12 0 0 .001 1 0 .001 1 .49 .001 0 .49 .001\n";
  return text;
}

const std::string kRound = "void metal wall 0 0 5 .7 .7 .7 1 .1\n";
const std::string kElliptic = "void metal2 wall 4 1 0 0 . 0 6 .7 .7 .7 1 .2 .05\n";

struct Both {
  Sample apart, shared;
};

// The wall as a ray sees it that comes down at an angle, a little above the table.
Both wallSeen(const std::string& scene, int count) {
  RayOptions o = unbiased();
  o.specularSampling = 1;
  Traced room(scene, o);
  Both both;
  const V3d origin(.5, .2, .0325), direction = V3d(.02, .3, -.03).normalized();
  for (const bool share : {false, true}) {
    PathTracer tracer = room.tracerWith({}, {.sharesHighlights = share});
    Sample& sample = share ? both.shared : both.apart;
    for (int i = 0; i < count; ++i) {
      const uint64_t seed = mixBits(static_cast<uint64_t>(i + share * count));
      sample.add(tracer.trace(origin, direction, 0, seed).value.color.x);
    }
  }
  return both;
}

void expectSameMean(const Both& both) {
  const double error = std::hypot(both.apart.standardError(), both.shared.standardError());
  EXPECT_LT(std::abs(both.apart.mean() - both.shared.mean()), kMostSigmas * error)
      << both.apart.mean() << " and " << both.shared.mean();
  EXPECT_GT(std::abs(1.2 * both.apart.mean() - both.shared.mean()), kMostSigmas * error)
      << "the spoiled twin";
}

TEST(SharedHighlights, HaveTheSameMeanWithLessNoise) {
  for (const std::string& material : {kRound, kElliptic}) {
    const Both both = wallSeen(wallOn(material, false), 60000);
    expectSameMean(both);
    EXPECT_LT(both.shared.standardError(), both.apart.standardError() / 4) << material;
    EXPECT_GT(both.shared.mean(), .1);
  }
}

// A pane lies between: shadow rays pass it, and samples of the lobe find no source behind it.
TEST(SharedHighlights, LeaveTheLightBehindPanesToShadowRays) {
  expectSameMean(wallSeen(wallOn(kRound, true), 50000));
}

TEST(SharedHighlights, SharesAreProbabilities) {
  LightSource lamp;
  lamp.shape = PlaneLight{.area = 2};
  double before = 0;
  for (const double density : {0., .01, .1, 1., 10., 1e6}) {
    const double share = shareOfLobe(lamp, 1, .5, density);
    EXPECT_GE(share, before);
    EXPECT_LE(share, 1);
    before = share;
  }
  EXPECT_EQ(shareOfLobe(lamp, 1, .5, .1), 0) << "a wide lobe is left to shadow rays";
  EXPECT_GT(before, .99);
  lamp.shape = BallLight{};
  lamp.radius = .1;
  // A ball of .1 at 1 from its nearest point fills 2 pi (1 - cos) sr, its sine being .1 / 1.1.
  const double solidAngle = 2 * kPi * (1 - std::sqrt(1 - std::pow(.1 / 1.1, 2)));
  EXPECT_NEAR(shareOfLobe(lamp, 1, 1, 100), 100 * solidAngle / (1 + 100 * solidAngle), 1e-12);
}

}  // namespace
}  // namespace rsphere
