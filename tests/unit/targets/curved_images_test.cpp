#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/frame.h"
#include "targets/daylight_targets.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere::curved_images_test {
namespace {

const V3d kPoint(.6, 2.2, 1.1);

// A room whose south wall has a window, in full view of a column and a ball.
struct Setting : SphereSetting {
  explicit Setting(const std::string& text)
      : SphereSetting(sceneOf(kRoomWithAWindow + "void metal chrome 0 0 5 .9 .9 .9 1 0\n" +
                              "void metal steel 0 0 5 .9 .9 .9 1 .3\n" + text),
                      [](RayOptions& o) { o.ambientBounces = 1; }) {}
  // usual: as in TargetFinder.
  std::vector<FoundRegion> seenFrom(const V3d& point, double usual = 1e-9) const {
    const SphereTracing all = tracing(transport->aims());
    const SeenSources sources(transport->prepared());
    const auto objects = findSpecialObjects(transport->prepared().scene(), 1);
    return CurvedImages({all, objects, Contrasts(all, objects, sources)}).find(point, usual);
  }
};

const std::string kColumn = " cylinder c 0 0 7 1.5 3 0 1.5 3 2.7 .2\n",
                  kBall = " sphere b 0 0 4 1.5 3 1.2 .3\n";

// Of all directions around the region that see the window in the object, the share that lies in the region; 0
// if none does.
double covered(const Setting& setting, const V3d& point, const Silhouette& region) {
  PathTracer tracer = setting.transport->pathTracer();
  const Silhouette::Cap cap = region.surroundingCap();
  const double around = 3 * std::tan(cap.angle);
  const auto [u, v] = frame(cap.axis);
  int bright = 0, inside = 0;
  constexpr int kSide = 200;
  for (int i = 0; i < kSide; ++i)
    for (int k = 0; k < kSide; ++k) {
      const double alongU = around * (2 * (i + .5) / kSide - 1), alongV = around * (2 * (k + .5) / kSide - 1);
      const V3d direction = (cap.axis + alongU * u + alongV * v).normalized();
      if (!(tracer.trace(point, direction, 0, 1).value.color.y > .7)) continue;
      ++bright;
      inside += region.contains(direction);
    }
  return static_cast<double>(inside) / std::max(bright, 1);
}

TEST(CurvedImages, AreWhereDirectionsSeeThem) {
  for (const std::string& object : {kColumn, kBall}) {
    const Setting setting("chrome" + object);
    for (const V3d& point : {kPoint, V3d(2.6, 2, .4), V3d(1.2, 1.2, 1.5)}) {
      SCOPED_TRACE(object);
      const auto found = setting.seenFrom(point);
      ASSERT_EQ(found.size(), 1u) << point;
      EXPECT_GT(covered(setting, point, found[0].silhouette), .97) << point;
      const V3d elsewhere = point + V3d(.1, .1, .1);
      EXPECT_LT(covered(setting, elsewhere, found[0].silhouette), .97) << "would not see another place";
    }
  }
}

TEST(CurvedImages, AreSeenInSmoothObjectsAndWhereNothingHidesThem) {
  EXPECT_EQ(Setting("steel" + kColumn).seenFrom(kPoint).size(), 0u);
  const Setting chrome("chrome" + kColumn);
  EXPECT_EQ(chrome.seenFrom(V3d(1.5, 4, 1.2)).size(), 0u) << "behind the column";
  EXPECT_EQ(chrome.seenFrom(V3d(1.5, 3, 1.2)).size(), 0u) << "in the column";
  EXPECT_EQ(chrome.seenFrom(kPoint, 1e9).size(), 0u) << "too faint";
  const std::string screen = "white polygon s 0 0 12 0 2.6 0 1.25 2.6 0 1.25 2.6 2.6 0 2.6 2.6\n";
  EXPECT_EQ(Setting("chrome" + kColumn + screen).seenFrom(kPoint).size(), 0u);
}

}  // namespace
}  // namespace rsphere::curved_images_test
