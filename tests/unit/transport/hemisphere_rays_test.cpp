#include "transport/hemisphere_rays.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/transport/transport_fixture.h"
#include "transport/bright_spots.h"
#include "transport/openings.h"

namespace rsphere {
namespace {

// The parts of the rays sum to 1 on average, however few they are and whether or not they can be shared out to
// openings, spots and other directions.
TEST(HemisphereRays, FewRaysLeaveNoDirectionOut) {
  RayOptions o = unbiased(2);
  o.ambientAccuracy = .1;
  const Traced room(kSunlitRoom, o);
  const Transport& transport = room.transport();
  ASSERT_TRUE(transport.openings() && transport.spots());
  Ray root;
  root.point = V3d(2, 2, 3);
  root.normal = V3d(0, 0, -1);
  Openings::Aim openings;
  transport.openings()->aim(root.point, root.normal, openings);
  BrightSpots::Aim spots;
  transport.spots()->aim(root.point, root.normal, spots);
  ASSERT_GT(openings.share, .2);
  ASSERT_GT(spots.share * (1 - openings.share), .2);
  for (const int rays : {1, 2, 3, 8, 64}) {
    Random random(1);
    Sample sum;
    for (int i = 0; i < 60000 / rays; ++i) {
      double parts = 0;
      sendOverHemisphere(transport, transport.spots(), random, root, root.normal, root.normal,
                         kReflectedAmbient, rays, [&](Ray&, double part) { parts += part; });
      sum.add(parts);
    }
    expectMean(sum, 1, 1.05);
  }
}

}  // namespace
}  // namespace rsphere
