#include "transport/indirect_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/unit/transport/small_scenes.h"

namespace rsphere::indirect_light_test {
namespace {

using namespace small_scenes;

// The light of glow without reach comes by indirect rays alone: a floor receives light of the sky with -ab 1,
// and none with -ab 0.
TEST(Ambient, FirstBounceMeetsGlow) {
  const double p = .5;
  const std::string scene =
      plastic("m", p) + floor("m", 0, 1000) + glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 180\n";
  EXPECT_EQ(Traced(scene, unbiased(0)).value(V3d(0, 0, 1), kDown), 0);
  for (const int bounces : {1, 2, 5})
    EXPECT_NEAR(Traced(scene, unbiased(bounces)).mean(V3d(0, 0, 1), kDown, 2000).mean(), p, 1e-12);
}

TEST(Ambient, ValueStandsForTheBouncesNotFollowed) {
  RayOptions o = unbiased(0);
  o.ambientValue = Radiance(Color(.5, .25, 1));
  const std::string wall = plastic("wall", .4) + "wall bubble s\n0\n0\n4 0 0 0 1\n";
  const Color seen = Traced(wall, o).color(kOrigin, V3d(1, .2, .1));
  EXPECT_NEAR(seen.x, .2, 1e-12);
  EXPECT_NEAR(seen.y, .1, 1e-12);
  EXPECT_NEAR(seen.z, .4, 1e-12);
  for (const int bounces : {1, 3}) {
    o.ambientBounces = bounces;
    EXPECT_NEAR(Traced(wall, o).mean(kOrigin, V3d(1, .2, .1), 200).mean(), .5 * std::pow(.4, bounces + 1),
                1e-9);
  }
}

TEST(Ambient, DivisionsLowerTheSpread) {
  const std::string scene =
      plastic("m", .5) + floor("m") + glow(1, 0) + "sky source part\n0\n0\n4 1 0 1 60\n";
  RayOptions o = unbiased(1);
  const Sample one = Traced(scene, o).mean(V3d(0, 0, 1), kDown, 20000);
  o.ambientDivisions = 256;
  const Sample many = Traced(scene, o).mean(V3d(0, 0, 1), kDown, 1000);
  // Irradiance of radiance 1 over a cone of 30 degrees half-angle at 45 degrees: E = pi sin^2(30) cos(45).
  const double expected = .5 * .25 * std::sqrt(.5);
  expectMean(one, expected, 1.1);
  expectMean(many, expected, 1.02);
  EXPECT_LT(many.standardError() * std::sqrt(1000.), one.standardError() * std::sqrt(20000.) / 16)
      << "stratified directions do better than as many independent ones";
}

TEST(Ambient, ExcludedSurfacesTakeTheAmbientValue) {
  const std::string scene =
      plastic("m", .5) + floor("m") + glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 180\n";
  RayOptions o = unbiased(1);
  o.ambientValue = Radiance(.125);
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .5, 1e-12);
  o.ambientExcluded = {"m"};
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .0625, 1e-12);
  o.ambientExcluded.clear();
  o.ambientIncluded = {"other"};
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .0625, 1e-12);
  o.ambientIncluded = {"m"};
  EXPECT_NEAR(Traced(scene, o).value(V3d(0, 0, 1), kDown), .5, 1e-12);
}

}  // namespace
}  // namespace rsphere::indirect_light_test
