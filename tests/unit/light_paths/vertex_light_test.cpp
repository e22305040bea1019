#include "light_paths/vertex_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/light_paths/white_sphere.h"

namespace rsphere::vertex_light_test {
namespace {

using namespace white_sphere;

// The place on the wall in a direction from the middle, seen from just before it.
PlainPlace onWall(const PlainSurfaces& surfaces, const V3d& direction, VertexLight::Scratch& scratch) {
  const V3d from = .5 * direction;
  return surfaces.placeOf(from, direction, surfaces.look(from, direction, kFarAway, kNone),
                          scratch.functions);
}

TEST(VertexLight, DirectLightIsThatOfTheLampsSolidAngle) {
  const Traced room(kScene, unbiased(1));
  const PlainSurfaces surfaces(room.prepared());
  ASSERT_FALSE(surfaces.obstacle());
  const VertexLight light(room.prepared(), surfaces, emissionOf(room, surfaces, 100), 100, 1);
  VertexLight::Scratch scratch;
  const V3d direction = V3d(1, 2, 3).normalized();
  const PlainPlace place = onWall(surfaces, direction, scratch);
  ASSERT_TRUE(place.material);
  Random random(1);
  Sample found;
  for (int i = 0; i < 4000; ++i)
    found.add(light.directOf(place, {.view = direction}, random, scratch).color.x);
  expectMean(found, kReflectance * kIrradiance / kPi, 1.01);
}

// The light of up to `bounces` reflections, by vertices far away and by rays to the wall nearby.
TEST(VertexLight, IndirectLightIsAGeometricSeries) {
  constexpr int kBounces = 3;
  const Traced room(kScene, unbiased(kBounces));
  const PlainSurfaces surfaces(room.prepared());
  double series = 0;
  for (int bounces = 1; bounces <= kBounces; ++bounces) {
    series += std::pow(kReflectance, bounces);
    Sample found;
    for (uint64_t seed = 1; seed <= 60; ++seed) {
      const VertexLight light(room.prepared(), surfaces, emissionOf(room, surfaces, 500), 500, seed);
      VertexLight::Scratch scratch;
      Random random(seed);
      Sample one;
      for (int i = 0; i < 60; ++i) {
        const V3d direction = V3d(std::cos(i), std::sin(i), .9 * std::sin(7 * i)).normalized();
        one.add(light.indirectAt(onWall(surfaces, direction, scratch), {.bounces = bounces}, random, scratch)
                    .color.x);
      }
      found.add(one.mean());
    }
    SCOPED_TRACE(bounces);
    expectMean(found, kIrradiance / kPi * series, 1.03);
  }
}

}  // namespace
}  // namespace rsphere::vertex_light_test
