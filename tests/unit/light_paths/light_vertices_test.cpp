#include "light_paths/light_vertices.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/light_paths/white_sphere.h"

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
