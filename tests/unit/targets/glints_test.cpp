#include "targets/glints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "silhouettes/silhouette.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"

namespace rsphere::glints_test {
namespace {

struct Setting : SphereSetting {
  explicit Setting(const std::string& text)
      : SphereSetting(sceneOf("void metal chrome 0 0 5 .9 .9 .9 1 0\nvoid metal steel 0 0 5 .9 .9 .9 1 .1\n"
                              "void mirror silver 0 0 3 .9 .9 .9\nvoid light lamp 0 0 3 10 10 10\n"
                              "void plastic black 0 0 5 0 0 0 0 0\n" +
                              text),
                      [](RayOptions& o) { o.ambientBounces = 0; }) {}
  // usual: as in TargetFinder.
  std::vector<FoundRegion> seenFrom(const V3d& point, double usual = 1e-9) const {
    const std::vector<SpecialObject> objects = findSpecialObjects(scene, 1);
    const SphereTracing all = tracing();
    const SeenSources sources(transport->prepared());
    return Glints({all, objects, Contrasts(all, objects, sources)}).find(point, usual);
  }
};

constexpr const char* kBall = "chrome sphere b 0 0 4 1 2 3 .1\n";

// Of all directions that see a source in the ball, what share is in the regions that were found; and of the
// regions' directions, what share sees a source.
struct Found {
  int images = 0;
  double bright = 0, covered = 0, wasted = 0;
};

Found compare(const Setting& setting, const V3d& point) {
  const auto glints = setting.seenFrom(point);
  Found found;
  found.images = static_cast<int>(glints.size());
  const Silhouette whole = silhouetteOf(Shape(Sphere{V3d(1, 2, 3), .1}), {}, point);
  PathTracer tracer = setting.transport->pathTracer();
  int inRegions = 0, dark = 0;
  constexpr int kSide = 300;
  for (int i = 0; i < kSide; ++i)
    for (int k = 0; k < kSide; ++k) {
      const V3d direction = whole.sample((i + .5) / kSide, (k + .5) / kSide);
      const bool bright = tracer.trace(point, direction, 0, 1).value.color.y > 1;
      bool in = false;
      for (const FoundRegion& g : glints) in = in || g.silhouette.contains(direction);
      found.bright += bright;
      found.covered += bright && in;
      inRegions += in;
      dark += in && !bright;
    }
  if (found.bright > 0) found.covered /= found.bright;
  if (inRegions > 0) found.wasted = static_cast<double>(dark) / inRegions;
  return found;
}

TEST(Glints, AreWhereTheBallShowsTheSource) {
  int compared = 0;
  for (const char* lamp :
       {"lamp polygon l 0 0 12 1 1 5 1 2 5 2 2 5 2 1 5\n", "lamp sphere l 0 0 4 4 2 4 .4\n",
        "lamp ring l 0 0 8 1 1 5 0 0 -1 0 .5\n", "lamp source l 0 0 4 .5 .2 1 10\n",
        "lamp polygon l 0 0 9 1 1.5 5 1.5 2.3 5 2 1.5 5\n",
        "lamp sphere l 0 0 4 4 2 4 .4\nlamp sphere m 0 0 4 0 -3 3 .3\n"}) {
    const Setting setting(std::string(kBall) + lamp);
    for (const V3d& point : {V3d(4, -1, 1), V3d(1.3, 2.1, 4), V3d(1, 1.8, 2.9)}) {
      const Found found = compare(setting, point);
      if (found.bright < 60) continue;
      ++compared;
      EXPECT_GT(found.covered, .95) << lamp << point;
      // A disk around a source that is turned away, or a triangle, holds much else.
      EXPECT_LT(found.wasted, .6) << lamp << point;
    }
  }
  EXPECT_GT(compared, 10);
}

TEST(Glints, OfWhatIsHiddenAreNone) {
  const std::string lamp = "lamp polygon l 0 0 12 1.2 1.8 5 1.2 2.2 5 1.6 2.2 5 1.6 1.8 5\n";
  const V3d point(4, -1, 4);
  EXPECT_EQ(Setting(kBall + lamp).seenFrom(point).size(), 1u);
  EXPECT_EQ(Setting(kBall + lamp + "black polygon p 0 0 12 -9 -9 4.9 9 -9 4.9 9 9 4.9 -9 9 4.9\n")
                .seenFrom(point)
                .size(),
            0u);
  // Half of it is seen past the edge, not its middle.
  EXPECT_EQ(Setting(kBall + lamp + "black polygon p 0 0 12 1.38 0 4.9 9 0 4.9 9 9 4.9 1.38 9 4.9\n")
                .seenFrom(point)
                .size(),
            1u);
  EXPECT_EQ(Setting(kBall + lamp + "black ring p 0 0 8 2.5 .5 3.5 1 -1 .3 0 .4\n").seenFrom(point).size(), 0u)
      << "hides the ball";
  // Turned away, inside the ball, rough, and no ball.
  EXPECT_EQ(Setting(kBall + std::string("lamp polygon l 0 0 12 1.2 1.8 5 1.6 1.8 5 1.6 2.2 5 1.2 2.2 5\n"))
                .seenFrom(point)
                .size(),
            0u);
  EXPECT_EQ(Setting(kBall + lamp).seenFrom(V3d(1, 2, 3.05)).size(), 0u);
  EXPECT_EQ(Setting("steel sphere b 0 0 4 1 2 3 .1\n" + lamp).seenFrom(point).size(), 0u);
  EXPECT_EQ(Setting("silver ring b 0 0 8 1 2 3 0 0 1 0 .1\n" + lamp).seenFrom(point).size(), 0u);
  EXPECT_EQ(Setting("silver sphere b 0 0 4 1 2 3 .1\n" + lamp).seenFrom(point).size(), 1u);
}

TEST(Glints, ThatMatterLittleAreLeftOut) {
  const Setting setting(std::string(kBall) +
                        "lamp polygon l 0 0 12 1.2 1.8 5 1.2 2.2 5 1.6 2.2 5 1.6 1.8 5\n");
  const V3d point(4, -1, 4);
  const auto found = setting.seenFrom(point);
  ASSERT_EQ(found.size(), 1u);
  // Half of 9 W/sr/m2, as if it filled half of its region.
  EXPECT_NEAR(found[0].deviation, 4.5, 1e-12);
  const double important = 81 * found[0].silhouette.regionSolidAngle();
  EXPECT_EQ(setting.seenFrom(point, std::sqrt(important / 2 / leastGlint(1))).size(), 1u);
  EXPECT_EQ(setting.seenFrom(point, std::sqrt(important * 30 / leastGlint(1))).size(), 0u);
}

}  // namespace
}  // namespace rsphere::glints_test
