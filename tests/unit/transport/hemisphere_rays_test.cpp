#include "transport/hemisphere_rays.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/transport/transport_fixture.h"
#include "transport/bright_spots.h"
#include "transport/openings.h"

namespace rsphere {
namespace {

// A room on a wide ground, with a pane in its south wall. The sun shines through it on the floor.
const std::string kSunlit =
    "void plastic white 0 0 5 .6 .6 .6 0 0\nvoid glass clear 0 0 3 .96 .96 .96\n"
    "void glow sky 0 0 4 1 1 1 0\nsky source heaven 0 0 4 0 0 1 180\n"
    "void light sunlight 0 0 3 1e6 1e6 1e6\nsunlight source sun 0 0 4 0 -1 1 .53\n"
    "white polygon ground 0 0 12 -400 -400 -.01 400 -400 -.01 400 400 -.01 -400 400 -.01\n"
    "white polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
    "white polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"
    "white polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"
    "white polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
    "white polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"
    "white polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1.5 0 1 1.5 0 2 2.5 0 2 2.5 0 1 1.5 0 1\n"
    "clear polygon window 0 0 12 1.5 0 1 2.5 0 1 2.5 0 2 1.5 0 2\n";

// The parts of the rays sum to 1 on average, however few they are and whether or not they can be shared out to
// openings, spots and other directions.
TEST(HemisphereRays, FewRaysLeaveNoDirectionOut) {
  RayOptions o = unbiased(2);
  o.ambientAccuracy = .1;
  const Traced room(kSunlit, o);
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
