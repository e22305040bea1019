#include "openings/portals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "tests/unit/support/room_with_hole.h"
#include "tests/unit/support/statistics.h"
#include "tests/unit/transport/transport_fixture.h"
#include "transport/find_aims.h"

namespace rsphere {
namespace {

const std::string kHoleInWall = "void plastic gray 0 0 5 .5 .5 .5 0 0\n" + kRoomWithHole +
                                "void glow sky_glow 0 0 4 1 1 1 0\nsky_glow source sky 0 0 4 0 0 1 360\n";

struct Hole {
  Traced traced{kHoleInWall, unbiased(1)};
  Portals portals{findOpenings(traced.prepared()), 4, kSamePlace};
};

bool isInHole(const V3d& point, const V3d& d) {
  if (!(d.y < 0)) return false;
  const V3d at = point - d * (point.y / d.y);
  return at.x > 1 && at.x < 3 && at.z > 1 && at.z < 2;
}

TEST(Portals, AreLeftFromInsideOnly) {
  const Hole hole;
  ASSERT_EQ(hole.portals.all().size(), 1u);
  const double lift = hole.portals.lift();
  EXPECT_NEAR(hole.portals.leaving(V3d(2, 3, 1.5), V3d(0, -1, 0), 10), 3 + lift, 1e-9);
  EXPECT_EQ(hole.portals.leaving(V3d(2, 3, 1.5), V3d(0, -1, 0), 2), kFarAway) << "ends before it";
  EXPECT_EQ(hole.portals.leaving(V3d(2, 3, 2.5), V3d(0, -1, 0), 10), kFarAway) << "passes above it";
  EXPECT_EQ(hole.portals.leaving(V3d(2, -3, 1.5), V3d(0, 1, 0), 10), kFarAway) << "enters by it";
  EXPECT_FALSE(hole.portals.lineLeaves(V3d(2, 3, 1.5), V3d(0, 1, 0), 10));
}

// The half of the room that it separates from the window is lit through it, but what is beyond is a room.
TEST(Portals, AreNotInGlassPartitions) {
  const std::string glass = "void glass clear 0 0 3 .96 .96 .96\n";
  const std::string window = "clear polygon window 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n";
  const std::string partition = "clear polygon partition 0 0 12 0 3.5 0 4 3.5 0 4 3.5 2.9 0 3.5 2.9\n";
  Traced traced{glass + kHoleInWall + window + partition, unbiased(1)};
  const Openings openings = findOpenings(traced.prepared());
  ASSERT_EQ(openings.all().size(), 2u) << "rays of gathers are aimed at the partition, too";
  const Portals portals(openings, 4, kSamePlace);
  ASSERT_EQ(portals.all().size(), 1u);
  EXPECT_NEAR(portals.all()[0].corner.y, 0, 1e-4);
}

// Its walls are indoors: glances and light paths find the sun on them.
TEST(Portals, AreNotInTheMouthOfAShaft) {
  const std::string shaft =
      "gray polygon below 0 0 12 1 0 1 3 0 1 3 -1.5 1 1 -1.5 1\n"
      "gray polygon above 0 0 12 1 0 2 1 -1.5 2 3 -1.5 2 3 0 2\n"
      "gray polygon left 0 0 12 1 0 1 1 -1.5 1 1 -1.5 2 1 0 2\n"
      "gray polygon right 0 0 12 3 0 1 3 0 2 3 -1.5 2 3 -1.5 1\n";
  const std::string pane =
      "void glass clear 0 0 3 .96 .96 .96\n"
      "clear polygon pane 0 0 12 1 -1.5 1 3 -1.5 1 3 -1.5 2 1 -1.5 2\n";
  Traced closed{kHoleInWall + shaft + pane, unbiased(1)}, open{kHoleInWall + shaft, unbiased(1)};
  const Openings openings = findOpenings(closed.prepared());
  ASSERT_EQ(openings.all().size(), 2u) << "rays of gathers are aimed at the mouth, too";
  const Portals portals(openings, 4, kSamePlace);
  ASSERT_EQ(portals.all().size(), 1u);
  EXPECT_NEAR(portals.all()[0].corner.y, -1.5, 1e-4);
  const Portals without(findOpenings(open.prepared()), 4, kSamePlace);
  ASSERT_FALSE(without.empty());
  EXPECT_GT(without.all()[0].at(.5, .5).y, -2) << "without a pane, the hole is the portal";
}

TEST(Portals, HaveTheProjectedAreaOfTheHole) {
  const Hole hole;
  EXPECT_NEAR(areaTowards(hole.portals.all(), V3d(0, .6, -.8)), 2 * .6, 1e-6);
  EXPECT_EQ(areaTowards(hole.portals.all(), V3d(0, -.6, -.8)), 0);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
    const V3d at = pointTowards(hole.portals.all(), V3d(0, .6, -.8), u1, u2, u3);
    EXPECT_TRUE(at.x >= 1 && at.x <= 3 && at.z >= 1 && at.z <= 2) << at;
  }
}

// Together, they have the hole's configuration factor, which a grid over the hole finds as well.
TEST(PortalDirections, WeighWhatIsSeenOfTheHole) {
  const Hole hole;
  for (const V3d& point : {V3d(2, 2, .8), V3d(.4, .3, .8), V3d(3.5, 3.9, 0)}) {
    const PortalDirections directions(hole.portals, point, V3d(0, 0, 1));
    Random random(1);
    Sample through;
    double steps = 0, inside = 0;
    int beside = 0;
    for (int i = 0; i < 60000; ++i) {
      const PortalDirections::Sample sample = directions.draw(random);
      through.add(sample.share);
      beside += sample.share > 0 && !isInHole(point, sample.direction);
    }
    // The configuration factor by a fine grid over the hole: cos cos / (pi d^2).
    constexpr int kSteps = 400;
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < kSteps; ++k) {
        const V3d to = V3d(1 + 2 * (i + .5) / kSteps, 0, 1 + (k + .5) / kSteps) - point;
        const double length2 = to.length2();
        inside += std::max(0., to.z) * -to.y / (kPi * length2 * length2) * 2;
        ++steps;
      }
    EXPECT_LT(beside, 10) << "portals lie outside of the hole, by little";
    expectMean(through, inside / steps, 1.05);
  }
}

}  // namespace
}  // namespace rsphere
