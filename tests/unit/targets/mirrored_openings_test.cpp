#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/frame.h"
#include "targets/daylight_targets.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere::mirrored_openings_test {
namespace {

// A mirror on the west wall of a room whose south wall has a window.
constexpr const char* kMirror = " polygon m 0 0 12 .02 .5 .1 .02 4.5 .1 .02 4.5 2.5 .02 .5 2.5\n";
const V3d kPoint(1.5, 2, 1.2);

struct Setting : SphereSetting {
  explicit Setting(const std::string& text)
      : SphereSetting(
            sceneOf(kRoomWithAWindow + "void metal chrome 0 0 5 .9 .9 .9 1 0\n" +
                    "void metal steel 0 0 5 .9 .9 .9 1 .1\nvoid mirror silver 0 0 3 .9 .9 .9\n" + text),
            [](RayOptions& o) { o.ambientBounces = 1; }) {}
  // usual: as in TargetFinder.
  std::vector<FoundRegion> seenFrom(const V3d& point, double usual = 1e-9) const {
    const SphereTracing all = tracing(transport->aims());
    const SeenSources sources(transport->prepared());
    return MirroredOpenings({all, {}, Contrasts(all, {}, sources)}).find(point, usual);
  }
};

// Of all directions around the region that see the window in the mirror, the share that lies in the region;
// and of the region's directions, the share that does not see it.
struct Found {
  double covered = 0, wasted = 0;
};
Found compare(const Setting& setting, const V3d& point, const Silhouette& region) {
  PathTracer tracer = setting.transport->pathTracer();
  const Silhouette::Cap cap = region.surroundingCap();
  const double around = 1.5 * std::tan(cap.angle);
  const auto [u, v] = frame(cap.axis);
  int bright = 0, brightInside = 0, inside = 0;
  constexpr int kSide = 100;
  for (int i = 0; i < kSide; ++i)
    for (int k = 0; k < kSide; ++k) {
      const double alongU = around * (2 * (i + .5) / kSide - 1), alongV = around * (2 * (k + .5) / kSide - 1);
      const V3d direction = (cap.axis + alongU * u + alongV * v).normalized();
      const bool isBright = tracer.trace(point, direction, 0, 1).value.color.y > .7,
                 isIn = region.contains(direction);
      bright += isBright;
      inside += isIn;
      brightInside += isBright && isIn;
    }
  return {static_cast<double>(brightInside) / std::max(bright, 1),
          1 - static_cast<double>(brightInside) / std::max(inside, 1)};
}

TEST(MirroredOpenings, AreWhereDirectionsSeeThem) {
  const Setting setting(std::string("chrome") + kMirror);
  for (const V3d& point : {kPoint, V3d(1, 3, 1.2), V3d(2.5, 4.5, 2), V3d(2.5, 2, .6)}) {
    const auto found = setting.seenFrom(point);
    ASSERT_EQ(found.size(), 1u) << point;
    EXPECT_GT(compare(setting, point, found[0].silhouette).covered, .97) << point;
    EXPECT_LT(compare(setting, point, found[0].silhouette).wasted, .06) << point;
    const V3d elsewhere = point + V3d(.2, .2, .2);
    EXPECT_LT(compare(setting, elsewhere, found[0].silhouette).covered, .97) << "would not see another place";
  }
}

TEST(MirroredOpenings, AreOnlySeenInSmoothMirrorsAndFromInFront) {
  EXPECT_EQ(Setting(std::string("silver") + kMirror).seenFrom(kPoint).size(), 1u);
  EXPECT_EQ(Setting(std::string("steel") + kMirror).seenFrom(kPoint).size(), 0u);
  EXPECT_EQ(Setting("").seenFrom(kPoint).size(), 0u);
  const Setting chrome(std::string("chrome") + kMirror);
  EXPECT_EQ(chrome.seenFrom(V3d(.01, 2, 1.2)).size(), 0u) << "behind the mirror";
  EXPECT_EQ(chrome.seenFrom(V3d(1, .2, .5)).size(), 0u) << "the image lies beside the mirror";
  EXPECT_EQ(chrome.seenFrom(kPoint, 1e9).size(), 0u) << "too faint";
}

TEST(MirroredOpenings, AreLeftOutWhereTheyAreHidden) {
  const auto behindScreen = [](const std::string& top) {
    return Setting(std::string("chrome") + kMirror + "white polygon screen 0 0 12 .3 .2 0 .3 3 0 .3 3 " +
                   top + " .3 .2 " + top + "\n")
        .seenFrom(kPoint)
        .size();
  };
  EXPECT_EQ(behindScreen("2.7"), 0u);
  EXPECT_EQ(behindScreen(".5"), 1u) << "it is seen above a low screen";
}

}  // namespace
}  // namespace rsphere::mirrored_openings_test
