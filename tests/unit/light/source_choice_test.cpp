#include "light/source_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

constexpr const char* kEverySort =
    "void light bright\n0\n0\n3 5 5 5\n"
    "void glow near\n0\n0\n4 2 2 2 3\n"
    "void spotlight beam\n0\n0\n7 9 9 9 40 0 0 -1\n"
    "bright polygon panel\n0\n0\n12 0 0 3 0 1 3 2 1 3 2 0 3\n"
    "bright sphere bulb\n0\n0\n4 3 3 1 .2\n"
    "bright cylinder tube\n0\n0\n7 -1 -1 2 -1 2 2 .05\n"
    "bright ring disk\n0\n0\n8 1 3 2.5 .3 .2 -1 0 .4\n"
    "near polygon patch\n0\n0\n12 -1 3 0 0 3 0 0 3 1 -1 3 1\n"
    "beam ring spot\n0\n0\n8 2 2 3 0 0 -1 0 .2\n"
    "bright source sun\n0\n0\n4 1 1 1 3\n"
    "bright source half\n0\n0\n4 0 1 1 170\n";

// What has no weight is never drawn: a sample of it would be lost.
TEST(SourceChoice, WeighsAllThatCanBeSampled) {
  const Scene scene = sceneOf(kEverySort);
  const LightSources lights(scene);
  const SourceChoice choice(scene, lights);
  Random random(1);
  std::vector<uint32_t> all(lights.all().size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> weights;
  std::vector<SourceSample> samples;
  std::vector<int> met(lights.all().size(), 0), unweighed(lights.all().size(), 0);
  for (int i = 0; i < 20000; ++i) {
    const V3d point(6 * random.uniform() - 2, 6 * random.uniform() - 2, 6 * random.uniform() - 2);
    const V3d away(random.uniform() - .5, random.uniform() - .5, random.uniform() - .5);
    const V3d front = i % 3 ? away.normalized() : V3d(0, 0, 0);
    choice.weigh(point, front, all, weights);
    for (const LightId k : lights.all().ids()) {
      samples.clear();
      lights.sample(k, point, {0, 1, front}, random, samples);
      const bool counts = !samples.empty() && (i % 3 == 0 || samples[0].direction.dot(front) > 0);
      ASSERT_GE(weights[k.index()], 0);
      ASSERT_TRUE(weights[k.index()] > 0 || !counts)
          << "source " << k.number() << " from " << point << " before " << front;
      met[k.index()] += counts;
      unweighed[k.index()] += weights[k.index()] == 0;
    }
  }
  for (size_t k = 0; k < met.size(); ++k) EXPECT_GT(met[k], 100) << "source " << k;
  EXPECT_GT(unweighed[0], 100) << "behind it";
  EXPECT_GT(unweighed[4], 100) << "beyond its reach";
  EXPECT_GT(unweighed[5], 100) << "outside its spot";
}

// In the plane of a source, the sign of the height above it is a rounding error, which differed between eye
// rays and light paths: with several goals, means of importance were up to 7% too small.
TEST(SourceChoice, APlaneSourceHasNoWeightInItsOwnPlane) {
  const Scene scene = sceneOf(
      "void light bright\n0\n0\n3 5 5 5\n"
      "bright polygon table\n0\n0\n12 2.4 1.1 .74 5.8 1.1 .74 5.8 2.1 .74 2.4 2.1 .74\n");
  const LightSources lights(scene);
  const SourceChoice choice(scene, lights);
  const uint32_t all[] = {0};
  std::vector<double> weights;
  for (const double z : {.74, std::nextafter(.74, 1.), std::nextafter(.74, 0.), .74 + 1e-12})
    for (const double x : {2.5, 4.1, 5.7, 9.})
      EXPECT_EQ(choice.weigh(V3d(x, 1.6, z), V3d(0, 0, 1), all, weights), 0) << x << ' ' << z;
  EXPECT_GT(choice.weigh(V3d(4.1, 1.6, .75), V3d(0, 0, -1), all, weights), 0);
}

// The better weights fit what sources bring, the less answers scatter: from afar they are what they bring.
TEST(SourceChoice, WeighsByIrradiance) {
  const Scene scene = sceneOf(
      "void light lamp\n0\n0\n3 2 2 2\nvoid light strong\n0\n0\n3 7 7 7\n"
      "lamp polygon panel\n0\n0\n12 0 0 3 0 .2 3 .3 .2 3 .3 0 3\n"
      "strong sphere bulb\n0\n0\n4 2 1 4 .1\n"
      "lamp ring disk\n0\n0\n8 -3 0 3 1 0 -1 0 .1\n"
      "strong cylinder tube\n0\n0\n7 -.2 -3 2 .2 -3 2 .01\n"
      "lamp source sun\n0\n0\n4 1 0 1 1\n");
  const LightSources lights(scene);
  const SourceChoice choice(scene, lights);
  Random random(1);
  std::vector<uint32_t> all(lights.all().size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> weights;
  choice.weigh(V3d(0, 0, 0), V3d(0, 0, 1), all, weights);
  for (const LightId k : lights.all().ids()) {
    std::vector<SourceSample> samples;
    lights.sample(k, V3d(0, 0, 0), {}, random, samples);
    ASSERT_EQ(samples.size(), 1u);
    const double irradiance =
        (k.index() == 1 || k.index() == 3 ? 7 : 2) * samples[0].solidAngle * samples[0].direction.z;
    EXPECT_NEAR(weights[k.index()], irradiance, .05 * irradiance) << "source " << k.number();
  }
}

}  // namespace
}  // namespace rsphere
