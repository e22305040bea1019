#include "light_paths/light_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/light_paths/white_sphere.h"
#include "tests/unit/support/room_with_hole.h"
#include "transport/find_aims.h"

namespace rsphere::light_vertices_test {
namespace {

using namespace white_sphere;

// All of the lamp's light arrives at the wall, and of that a part after each bounce.
TEST(LightVertices, HaveThePowerOfTheLampAndOfItsReflections) {
  constexpr int kBounces = 3;
  const Traced room(kScene, unbiased(kBounces));
  const PlainSurfaces surfaces(room.prepared());
  constexpr size_t kPaths = 500;
  std::array<Sample, kBounces> power;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    const LightVertices vertices(room.prepared(), surfaces, emissionOf(room, surfaces, kPaths), kPaths, seed);
    std::array<double, kBounces> sums{};
    for (size_t i = 0; i < vertices.all().size(); ++i) {
      const LightVertex& v = vertices.all()[i];
      ASSERT_GE(v.bounces, 1);
      ASSERT_LE(v.bounces, kBounces);
      sums[v.bounces - 1] += vertices.powerOf(i).color.x;
      EXPECT_NEAR(v.point().length(), 1, 1e-6);
      EXPECT_NEAR(v.normal().dot(v.point()), -1, 1e-6);
    }
    for (size_t i = 0; i < sums.size(); ++i) power[i].add(sums[i]);
  }
  const double ofLamp = 4 * kPi * kRadius * kRadius * kPi * kLamp;
  for (int i = 0; i < kBounces; ++i) {
    SCOPED_TRACE(i + 1);
    expectMean(power[i], ofLamp * std::pow(kReflectance, i + 1), 1.05);
  }
}

// The sun shines through a frosted pane onto a glossy floor. The few light paths that bring it are split
// there, so that no vertex of the highlight has much more light than the mean path.
TEST(LightVertices, OfMuchLightAreSplit) {
  const Traced room(
      "void plastic gray 0 0 5 .5 .5 .5 .1 .2\nvoid trans frosted 0 0 7 .6 .6 .6 0 .05 .6 .5\n"
      "void glow sky 0 0 4 1 1 1 0\nsky source heaven 0 0 4 0 0 1 180\n"
      "void light sunlight 0 0 3 1e6 1e6 1e6\nsunlight source sun 0 0 4 0 -1 1 .53\n"
      "frosted polygon window 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n" +
          kRoomWithHole,
      unbiased(3));
  const Portals portals(findOpenings(room.prepared()), 4, kSamePlace);
  const PlainSurfaces surfaces(room.prepared(), portals);
  PathTracer tracer = room.tracerWith({});
  const auto beyond = [&](const V3d& origin, const V3d& direction, int bounces, Random& random,
                          std::vector<Radiance>& parts) {
    tracer.outdoors(origin, direction, bounces, random.bits(), parts);
  };
  const OutdoorParts outdoors(beyond);
  constexpr size_t kPaths = 8000;
  const LightVertices vertices(room.prepared(), surfaces, emissionOf(room, surfaces, kPaths / 2), kPaths, 1,
                               &outdoors);
  double onFloor = 0, inHighlight = 0;
  for (size_t i = 0; i < vertices.all().size(); ++i)
    if (vertices.all()[i].way == LightVertex::unweighed)
      onFloor = std::max(onFloor, brightness(vertices.powerOf(i)));
  for (const VisibleVertex& v : vertices.visible().all())
    if (v.vertex.way == LightVertex::sharp) inHighlight = std::max(inHighlight, brightness(v.power));
  EXPECT_GT(onFloor, 10 * vertices.pathPower());
  EXPECT_GT(inHighlight, .1 * vertices.pathPower());
  EXPECT_LT(inHighlight, 3 * vertices.pathPower());
}

// Rays to near surfaces and vertices far away share the light between two places.
TEST(NearLight, FallsFromOneToZero) {
  const NearLight near{.width = .5};
  EXPECT_EQ(near.share(0), 1);
  EXPECT_EQ(near.share(.5), .5);
  EXPECT_NEAR(near.share(5), 1e-4, 1e-7);
  for (const double share : {.9, .5, .01}) EXPECT_NEAR(near.share(near.distanceOf(share)), share, 1e-12);
}

}  // namespace
}  // namespace rsphere::light_vertices_test
