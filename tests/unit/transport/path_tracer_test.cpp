#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/transport/small_scenes.h"
#include "transport/transport.h"

namespace rsphere::path_tracer_test {
namespace {

using namespace small_scenes;

// Glow and an ambient value are light as well as lamps are.
TEST(Light, IsMissedOnlyWhereNothingCanGiveIt) {
  const std::string walls = plastic("paint", .5) + floor("paint");
  RayOptions ambient;
  ambient.ambientValue = Radiance(Color(0, .1, 0));
  EXPECT_TRUE(isDark(Traced(walls).prepared()));
  EXPECT_FALSE(isDark(Traced(walls, ambient).prepared()));
  EXPECT_FALSE(isDark(Traced(walls + light(1) + "lamp sphere bulb\n0\n0\n4 0 0 5 .5\n").prepared()));
  EXPECT_FALSE(isDark(Traced(walls + glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n").prepared()));
  EXPECT_TRUE(isDark(Traced(walls + light(1)).prepared()));  // not used
}

TEST(Enclosure, OfGlowIsSeenAsItIs) {
  Traced box(glow(1, 0) +
             "sky polygon a\n0\n0\n12 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 -1\n"
             "sky polygon b\n0\n0\n12 -1 1 1 1 1 1 1 -1 1 -1 -1 1\n"
             "sky polygon c\n0\n0\n12 -1 -1 1 1 -1 1 1 -1 -1 -1 -1 -1\n"
             "sky polygon d\n0\n0\n12 1 1 -1 1 1 1 -1 1 1 -1 1 -1\n"
             "sky polygon e\n0\n0\n12 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1\n"
             "sky polygon f\n0\n0\n12 1 -1 1 1 1 1 1 1 -1 1 -1 -1\n");
  Random random(31);
  for (int i = 0; i < 5000; ++i)
    EXPECT_EQ(box.value(randomPoint(random, .99), randomDirection(random)), 1)
        << "hole or wrong side, ray " << i;
}

// A furnace: in uniform light of radiance 1, a surface that absorbs nothing has radiance 1.
TEST(Enclosure, FurnaceHidesWhatAbsorbsNothing) {
  const std::string sky = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  struct Case {
    std::string material;
    double lost;  // largest share that the model loses
  };
  for (const auto& [material, lost] :
       std::vector<Case>{{"void plastic m\n0\n0\n5 1 1 1 0 0\n", 0},
                         {"void trans m\n0\n0\n7 1 1 1 0 0 .5 0\n", 0},
                         {"void trans m\n0\n0\n7 1 1 1 0 0 .5 .5\n", 0},
                         {"void metal m\n0\n0\n5 1 1 1 1 0\n", 0},
                         {"void mirror m\n0\n0\n3 1 1 1\n", 0},
                         {"void glass m\n0\n0\n3 1 1 1\n", 0},
                         {"void dielectric m\n0\n0\n5 1 1 1 1.5 0\n", 0},
                         // Samples of a rough lobe that would leave under the surface are lost.
                         {"void metal m\n0\n0\n5 1 1 1 1 .05\n", .01}}) {
    Traced furnace(sky + material + "m sphere ball\n0\n0\n4 0 0 0 1\n", unbiased(40));
    const Sample seen = furnace.mean(V3d(0, .3, 3), V3d(0, 0, -1), 500);
    EXPECT_NEAR(seen.mean(), 1, lost + kMostSigmas * seen.standardError() + 1e-3) << material;
  }
}

// The integrating sphere: with -ab n a radiance ray sees L_n = L_inf (1 - q^(n+1)). By direct light, the
// radiance of the wall is p Ls (r/R)^2. The lamp, which is black to indirect rays, absorbs a share of (r/R)^2
// of the light that the wall reflects.
TEST(Enclosure, IntegratingSphereSumsItsGeometricSeries) {
  for (const double p : {.3, .8})
    for (const int bounces : {0, 1, 2, 8}) {
      const double share = .1 * .1, q = p * (1 - share), first = p * 100 * share;
      Traced sphere(plastic("wall", p) + light(100) +
                        "wall bubble s\n0\n0\n4 0 0 0 1\nlamp sphere l\n0\n0\n4 0 0 0 .1\n",
                    unbiased(bounces));
      const auto seen = [&](int n) { return first * (1 - std::pow(q, n + 1)) / (1 - q); };
      SCOPED_TRACE(testing::Message() << "reflectance " << p << ", -ab " << bounces);
      const bool countsOnce = std::pow(q, bounces + 1) > .01;
      expectMean(sphere.mean(V3d(.5, 0, 0), V3d(1, .2, .1), 40000), seen(bounces),
                 countsOnce ? seen(bounces + 1) / seen(bounces) : 1.02);
    }
}

// There is no reflection along a straight path through a ball of index 1: the transmittance is exp(-a d).
TEST(Medium, AbsorbsByItsLength) {
  const std::string sky = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  Traced scene(sky + "void dielectric d\n0\n0\n5 .5 .9 1 1 0\nd sphere s\n0\n0\n4 0 0 0 1.5\n", unbiased());
  const Color seen = scene.color(V3d(0, 0, 5), kDown);
  EXPECT_NEAR(seen.x, .125, 1e-9);
  EXPECT_NEAR(seen.y, .729, 1e-9);
  EXPECT_NEAR(seen.z, 1, 1e-9);
  const Color inside = scene.color(V3d(0, 0, .5), kDown);
  EXPECT_NEAR(inside.x, .25, 1e-9) << "a ray that starts inside is told the medium by the surface it meets";
}

TEST(Medium, DielectricFocusesAsALensAndKeepsEnergy) {
  const std::string sky = glow(1, 0) + "sky source all\n0\n0\n4 0 0 1 360\n";
  Traced scene(sky + "void dielectric d\n0\n0\n5 1 1 1 1.5 0\nd sphere s\n0\n0\n4 0 0 0 1\n", unbiased());
  for (const double x : {0., .3, .6, .9}) EXPECT_NEAR(scene.value(V3d(x, 0, 5), kDown), 1, 1e-6);
}

TEST(PathTracer, AnswersDoNotDependOnWhatWasTracedBefore) {
  RayOptions o = unbiased(3);
  o.ambientDivisions = 16;
  const std::string scene = plastic("wall", .7) + "void metal m\n0\n0\n5 .8 .8 .8 .9 .1\n" + light(100) +
                            "wall bubble s\n0\n0\n4 0 0 0 1\nlamp sphere l\n0\n0\n4 0 0 .3 .1\n"
                            "m sphere ball\n0\n0\n4 .3 0 -.3 .2\n";
  Traced traced(scene, o);
  Random random(33);
  std::vector<std::pair<V3d, V3d>> rays;
  for (int i = 0; i < 50; ++i) rays.emplace_back(randomPoint(random, .2), randomDirection(random));
  std::vector<Color> forward;
  for (size_t i = 0; i < rays.size(); ++i)
    forward.push_back(traced.color(rays[i].first, rays[i].second, 100 + i));
  for (size_t i = rays.size(); i-- > 0;)
    EXPECT_EQ(traced.color(rays[i].first, rays[i].second, 100 + i), forward[i]);
  int same = 0;
  for (size_t i = 0; i < rays.size(); ++i)
    same += traced.color(rays[i].first, rays[i].second, 900 + i) == forward[i];
  EXPECT_LT(same, 25) << "other seeds, other answers";
}

}  // namespace
}  // namespace rsphere::path_tracer_test
