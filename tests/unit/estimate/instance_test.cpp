#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimate/estimator.h"
#include "silhouettes/special_objects.h"
#include "tests/unit/support/files_of.h"
#include "tests/unit/support/scene_of.h"
#include "trace/tracer.h"

// Special objects in octrees and meshes: where they are seen.
namespace rsphere {
namespace {

V3d inBox(Random& random, double half) {
  return half * V3d(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
}

constexpr const char* kMaterials =
    "void plastic matt\n0\n0\n5 .5 .5 .5 0 0\nvoid metal chrome\n0\n0\n5 .8 .8 .8 .9 0\n"
    "void glass pane\n0\n0\n3 .9 .9 .9\n";
constexpr const char* kThings =
    "matt sphere s0\n0\n0\n4 .3 .2 .1 .4\nchrome sphere s1\n0\n0\n4 -.6 .2 .4 .3\n"
    "pane polygon p1\n0\n0\n12 -1 -1 -.8 1 -1 -.8 1 1 -.8 -1 1 -.8\n"
    "chrome cylinder c1\n0\n0\n7 -.8 -.8 -.8 -.7 .2 .6 .15\npane cone c2\n0\n0\n8 .6 -.5 -.6 .6 -.4 .5 .3 "
    ".1\n"
    "chrome ring r1\n0\n0\n8 0 .6 .3 .3 .4 1 .1 .5\n";
constexpr const char* kInner = "-mx -rz 70 -s .3 -t -1 .2 .3";
constexpr const char* kOuter = "-ry 20 -s 2 -t 3 0 1";

std::string instance(const std::string& file, const std::string& transform, const char* modifier = "void",
                     const char* type = "instance") {
  return fmt::format("{} {} i\n{} {} {}\n0\n0\n", modifier, type,
                     2 + std::count(transform.begin(), transform.end(), ' '), file, transform);
}

// Every ray that shows something special goes in a direction of one of the silhouettes. How many did.
int raysInSilhouettes(const Scene& scene, const std::vector<SpecialObject>& objects) {
  const Tracer tracer(scene, true);
  Random random(5);
  int hits = 0;
  for (int k = 0; k < 30; ++k) {
    const V3d point = V3d(2, 0, 1) + inBox(random, 5);
    std::vector<Silhouette> silhouettes;
    for (const SpecialObject& o : objects) silhouettes.push_back(silhouetteOf(scene, o, point));
    for (int i = 0; i < 400; ++i) {
      const V3d d = (V3d(2, 0, 1) + inBox(random, 3) - point).normalized();
      const Hit hit = tracer.nearest(point, d);
      bool special = false, covered = false;
      for (size_t o = 0; o < objects.size(); ++o) {
        if (!shows(scene, objects[o], hit.surface)) continue;
        special = true;
        covered = covered || silhouettes[o].contains(d);
      }
      hits += special;
      EXPECT_EQ(special, covered) << k << ' ' << i;
    }
  }
  return hits;
}

TEST(PlacedSpecialObjects, AreSeenWhereTheyWouldBeWrittenOut) {
  const SceneFolder folder;
  const std::string text = std::string(kMaterials) + kThings;
  const std::string things = folder.write("things.rad", text);
  const std::string middle = folder.octree("middle.oct", instance(folder.octree("inner.oct", text), kInner));
  const Scene scene = sceneOf(instance(middle, kOuter));
  const Scene flat = sceneOf(fmt::format("!xform {} {} {}\n", kInner, kOuter, things));
  const auto objects = findSpecialObjects(scene, 1), written = findSpecialObjects(flat, 1);
  ASSERT_EQ(objects.size(), 5u);
  ASSERT_EQ(written.size(), 5u);
  Random random(3);
  for (size_t i = 0; i < objects.size(); ++i) {
    EXPECT_EQ(scene.surfaceName(scene.surfaces[objects[i].surface]),
              flat.surfaceName(flat.surfaces[written[i].surface]));
    EXPECT_EQ(objects[i].density, written[i].density);
    for (int k = 0; k < 50; ++k) {
      const V3d point = inBox(random, 4);
      const Silhouette a = silhouetteOf(scene, objects[i], point), b = silhouetteOf(flat, written[i], point);
      EXPECT_NEAR(a.solidAngle(), b.solidAngle(), 1e-9);
      EXPECT_NEAR(a.regionSolidAngle(), b.regionSolidAngle(), 1e-9);
      EXPECT_TRUE(!(a.regionSolidAngle() > 0) || b.contains(a.sample(.3, .6)));
    }
  }
  EXPECT_GT(raysInSilhouettes(scene, objects), 100);
  EXPECT_NE(specialObjectsText(scene, objects).find("sphere \"s1\"\tmetal \"chrome\""), std::string::npos);
}

TEST(PlacedSpecialObjects, AnInstanceThatIsSpecialItselfIsABall) {
  const SceneFolder folder;
  const std::string oct = folder.octree("a.oct", std::string(kMaterials) + kThings);
  const Scene scene = sceneOf(kMaterials + instance(oct, kOuter, "chrome"));
  const auto objects = findSpecialObjects(scene, 1);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(scene.surfaceName(scene.surfaces[objects[0].surface]), "i");
  EXPECT_GT(raysInSilhouettes(scene, objects), 1000);
  const Scene dull = sceneOf(kMaterials + instance(oct, kOuter, "matt"));
  EXPECT_TRUE(findSpecialObjects(dull, 1).empty());
}

TEST(PlacedSpecialObjects, MeshesAreABallForEachMaterial) {
  const std::string file = std::string(RSPHERE_TESTS) + "/scenes/instances/roof.rtm";
  const Scene scene =
      sceneOf(instance(file, kOuter, "void", "mesh") + "void metal chrome\n0\n0\n5 .8 .8 .8 .9 0\n" +
              instance(file, "-t 0 2 0", "chrome", "mesh"));
  const auto objects = findSpecialObjects(scene, 1);
  std::vector<std::string> modifiers;
  for (const SpecialObject& o : objects)
    modifiers.emplace_back(scene.modifierName(scene.surfaces[o.surface]));
  EXPECT_EQ(modifiers, (std::vector<std::string>{"red", "pane", "brass", "chrome"}));
  EXPECT_GT(raysInSilhouettes(scene, objects), 500);
}

TEST(PlacedSpecialObjects, TooManyAreTakenTogether) {
  const SceneFolder folder;
  const std::string oct = folder.octree("a.oct", std::string(kMaterials) + kThings);
  std::string text = std::string(kMaterials) + "chrome sphere own\n0\n0\n4 2 0 1 .5\n";
  for (int i = 0; i < 1000; ++i)
    text += instance(oct, fmt::format("-s .4 -t {} {} {}", i % 10 - 3, i / 10 % 10 - 5, i / 100 - 4));
  const Scene scene = sceneOf(text);
  const auto objects = findSpecialObjects(scene, 1);
  ASSERT_EQ(objects.size(), 1001u);
  EXPECT_FALSE(objects[0].several);
  EXPECT_TRUE(objects[1].several);
  EXPECT_EQ(scene.surfaceName(scene.surfaces[objects[1].surface]), "s1");
  const Tracer tracer(scene, true);
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const V3d point = inBox(random, 4), d = inBox(random, 1).normalized();
    const Hit hit = tracer.nearest(point, d);
    const bool special = std::any_of(objects.begin(), objects.end(), [&](const SpecialObject& o) {
      return shows(scene, o, hit.surface) && silhouetteOf(scene, o, point).contains(d);
    });
    const bool shown = hit.surface != kNone && scene.materialName(scene.surfaces[hit.surface]) != "matt";
    EXPECT_EQ(special, shown) << i;
  }
}

// A point of a surface, and a ray that starts near it, hits that surface.
TEST(PlacedSpecialObjects, PointsLieOnWhatIsBroughtIn) {
  const SceneFolder folder;
  const std::string inner = folder.octree("a.oct", std::string(kMaterials) + kThings);
  const std::string middle = folder.octree("m.oct", instance(inner, kInner));
  const std::string file = std::string(RSPHERE_TESTS) + "/scenes/instances/roof.rtm";
  const Scene scene = sceneOf(instance(middle, kOuter) + instance(file, kOuter, "void", "mesh"));
  const Tracer tracer(scene, true);
  Random random(9);
  for (const Surface& surface : scene.outermost())
    for (int i = 0; i < 300; ++i) {
      const SurfacePoint at = samplePoint(scene, surface, random);
      ASSERT_GT(at.clearance, 0);
      EXPECT_NEAR(at.normal.length(), 1, 1e-12);
      const Hit hit = tracer.nearest(at.point + at.clearance * at.normal, -at.normal);
      ASSERT_NE(hit.surface, kNone);
      EXPECT_LE(hit.distance, at.clearance * (1 + 1e-6));
    }
}

TEST(PlacedSpecialObjects, TheMeanIsThatOfTheSceneWrittenOut) {
  const SceneFolder folder;
  const std::string text = std::string(kMaterials) + "chrome sphere ball\n0\n0\n4 0 0 0 .5\n";
  const std::string file = folder.write("ball.rad", text);
  const std::string oct = folder.octree("ball.oct", text);
  const std::string sky =
      "void brightfunc uneven\n2 1+Dz*Dx+if(Dy-.7,2,0) .\n0\n0\nuneven glow sky\n0\n0\n4 1 1 1 0\n"
      "sky source everywhere\n0\n0\n4 0 0 1 360\n";
  const auto mean = [&](const std::string& ball) {
    const Scene scene = sceneOf(sky + ball);
    const Transport transport(scene, RayOptions(), IrradianceAt::none);
    SphereOptions options;
    options.baseDirections = 1024;
    const SphereEstimator estimator(transport, options);
    EXPECT_EQ(findSpecialObjects(scene, options.densityFactor).size(), 1u);
    SphereEstimator::Workspace workspace(estimator);
    return estimator.estimate(V3d(.1, -.3, 1.2), workspace).mean.color.x;
  };
  const double written = mean("!xform -s .6 -t 0 0 .5 " + file + "\n");
  EXPECT_NEAR(mean(instance(oct, "-s .6 -t 0 0 .5")), written, .005 * written);
}

}  // namespace
}  // namespace rsphere
