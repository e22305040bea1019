#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/random.h"
#include "tests/unit/support/files_of.h"
#include "tests/unit/support/scene_of.h"
#include "trace/tracer.h"

// Hits in octrees and meshes: the same as without them, wherever they are placed.
namespace rsphere {
namespace {

V3d direction(Random& random) {
  const double z = 1 - 2 * random.uniform(), angle = 6.283185307179586 * random.uniform();
  const double r = std::sqrt(std::max(0., 1 - z * z));
  return V3d(r * std::cos(angle), r * std::sin(angle), z);
}
V3d inBox(Random& random, double half) {
  return half * V3d(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
}

constexpr const char* kMaterials =
    "void plastic gray\n0\n0\n5 .5 .5 .5 0 0\nvoid glass pane\n0\n0\n3 .9 .9 .9\n"
    "void metal coat\n0\n0\n5 .5 .5 .5 .9 0\nvoid dielectric ice\n0\n0\n5 .9 .9 .9 1.3 0\n";
constexpr const char* kThings =
    "gray sphere s1\n0\n0\n4 .3 .2 .1 .4\npane bubble s2\n0\n0\n4 -.5 .2 .4 .3\n"
    "gray polygon p1\n0\n0\n12 -1 -1 -.8 1 -1 -.7 1 1 -.8 -1 1 -.9\n"
    "coat cylinder c1\n0\n0\n7 -.8 -.8 -.8 -.7 .2 .6 .15\nvoid cone c2\n0\n0\n8 .6 -.5 -.6 .6 -.4 .5 .3 .1\n"
    "pane ring r1\n0\n0\n8 0 .6 .3 .3 .4 1 .1 .5\nice sphere s3\n0\n0\n4 .1 -.5 .3 .3\n";

// The things twice, as instances within an octree that is placed itself, and written out by xform.
struct Both {
  SceneFolder folder;
  Scene placed, flat;
  explicit Both(const std::string& outer, const std::string& modifier = "void") {
    const std::string things = folder.write("things.rad", std::string(kMaterials) + kThings);
    const std::string inner = folder.octree("inner.oct", std::string(kMaterials) + kThings);
    const auto words = [](const std::string& t) { return 2 + std::count(t.begin(), t.end(), ' '); };
    const std::string a = "-s .5 -rx 40 -t 1 0 0", b = "-mx -rz 70 -s .3 -t -1 .2 .3";
    const auto placedBy = [&](const std::string& by, const std::string& with) {
      return fmt::format("{} instance i\n{} {} {}\n0\n0\n", by, words(with), inner, with);
    };
    const std::string middle = folder.octree("middle.oct", placedBy("void", a) + placedBy("void", b));
    placed = sceneOf(kMaterials +
                     fmt::format("{} instance o\n{} {} {}\n0\n0\n", modifier, words(outer), middle, outer));
    const std::string over = modifier == "void" ? "" : "-m " + modifier + " ";
    flat = sceneOf(kMaterials + fmt::format("!xform {}{} {} {}\n!xform {}{} {} {}\n", over, a, outer, things,
                                            over, b, outer, things));
  }
};

std::string nameOf(const Scene& scene, const Hit& hit) {
  const std::string name(scene.surfaceName(scene.surfaces[hit.surface]));
  return name.substr(name.rfind('.') + 1);
}

// scale: of the outermost transform.
void expectSame(const Both& both, const V3d& center, double scale, const std::string& name) {
  const Tracer placed(both.placed, true), flat(both.flat, true);
  Random random(7);
  int hits = 0, blocked = 0, unsure = 0;
  for (int i = 0; i < 20000; ++i) {
    const V3d from = center + inBox(random, 2 * scale), d = direction(random);
    const Hit a = placed.nearest(from, d), b = flat.nearest(from, d);
    ASSERT_EQ(a.surface == kNone, b.surface == kNone) << name << i;
    const double within = 1e-9 * scale + 1e-14 * center.length();
    if (a.surface != kNone) {
      ++hits;
      EXPECT_NEAR(a.distance, b.distance, within / std::abs(b.cosine)) << i;
      EXPECT_LT((a.normal - b.normal).length(), 1e-9 + 1e-13 * center.length() / scale) << i;
      EXPECT_NEAR(a.cosine, b.cosine, 1e-9 + 1e-13 * center.length() / scale) << i;
      EXPECT_EQ(nameOf(both.placed, a), name.empty() ? nameOf(both.flat, b) : name) << i;
    }
    const double distance = 4 * scale * random.uniform();
    const Shadow s = placed.shadow(from, d, distance, kNone);
    EXPECT_EQ(s, flat.shadow(from, d, distance, kNone)) << i;
    blocked += s == Shadow::blocked;
    unsure += s == Shadow::unsure;
  }
  EXPECT_GT(hits, 150);
  EXPECT_GT(blocked, 40);
  EXPECT_GT(unsure, name.empty() ? 20 : -1);
}

// Two balls 20 apart, in an octree that is placed within another one.
TEST(Instances, SmallObjectsAreFoundWithinThem) {
  SceneFolder folder;
  const std::string inner = folder.octree(
      "inner.oct",
      std::string(kMaterials) + "gray sphere s1\n0\n0\n4 -10 0 0 .1\ngray sphere s2\n0\n0\n4 10 0 0 .1\n");
  const std::string middle =
      folder.octree("middle.oct", fmt::format("void instance i\n7 {} -rz 90 -t 0 0 5\n0\n0\n", inner));
  const Scene scene = sceneOf(fmt::format("void instance o\n7 {} -s 2 -t 100 0 0\n0\n0\n", middle));
  const Tracer tracer(scene, true);
  const V3d up(0, 0, 1);
  // The balls are .4 wide in the world, at (100, +-20, 10).
  EXPECT_TRUE(tracer.anySmallNear({V3d(100, 21, 10), up, .9, .5, 0}));
  EXPECT_FALSE(tracer.anySmallNear({V3d(100, 21, 10), up, .7, .5, 0})) << "farther away than that";
  EXPECT_FALSE(tracer.anySmallNear({V3d(100, 21, 10), up, .9, .3, 0})) << "wider than that";
  EXPECT_FALSE(tracer.anySmallNear({V3d(100, 0, 10), up, 5, .5, 0})) << "between the balls";
  EXPECT_TRUE(tracer.anySmallNear({V3d(100, 0, 10), up, 5, 50, 0})) << "the instance as a whole is small";
}

TEST(Instances, AreHitAsIfTheyWereWrittenOut) { expectSame(Both("-ry 20"), V3d(0, 0, 0), 1, ""); }
TEST(Instances, MirroredAndFarAway) {
  expectSame(Both("-my -ry 20 -s .01 -t 3000 -2000 500"), V3d(3000, -2000, 500), .01, "");
}
TEST(Instances, LargerThanTheirOctree) { expectSame(Both("-s 1000"), V3d(0, 0, 0), 1000, ""); }
TEST(Instances, WithAModifierStandForWhatIsInThem) {
  expectSame(Both("-ry 20", "coat"), V3d(0, 0, 0), 1, "o");
}

TEST(Instances, PathsLeadToTheOctreesCoordinates) {
  const Both both("-ry 20 -s 2");
  const Tracer tracer(both.placed, true);
  Random random(3);
  int spheres = 0;
  for (int i = 0; i < 20000; ++i) {
    const V3d from = inBox(random, 4), d = direction(random);
    const Hit hit = tracer.nearest(from, d);
    if (hit.surface == kNone) continue;
    ASSERT_EQ(hit.path.count, 2);
    const V3d at = both.placed.placementOf(hit.path).toInner.point(from + hit.distance * d);
    const auto* sphere = both.placed.surfaces[hit.surface].shape.as<Sphere>();
    if (!sphere) continue;
    ++spheres;
    EXPECT_NEAR((at - sphere->center).length(), sphere->radius, 1e-12);
  }
  EXPECT_GT(spheres, 50);
  const Both hidden("-ry 20 -s 2", "coat");
  const Tracer hides(hidden.placed, true);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(hides.nearest(inBox(random, 4), direction(random)).path.count, 0);
}

// An instance's own modifier is that of all that it brings in.
TEST(Instances, OfADielectricRefractShadowRays) {
  const SceneFolder folder;
  const std::string square = " polygon in\n0\n0\n12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n";
  const std::string file = std::string(RSPHERE_TESTS) + "/scenes/octree/box.rtm";
  const auto shadow = [&](const std::string& thing, double wall) {
    const Scene scene = sceneOf(std::string(kMaterials) + thing +
                                fmt::format("gray ring wall\n0\n0\n8 0 0 {} 0 0 1 0 9\n", wall));
    return Tracer(scene, true).shadow(V3d(.1, .2, 5), V3d(0, 0, -1), 20, kNone);
  };
  const auto instance = [&](const std::string& modifier, const std::string& inside) {
    const std::string oct =
        folder.octree(modifier + inside + ".oct", std::string(kMaterials) + inside + square);
    return modifier + " instance i\n1 " + oct + "\n0\n0\n";
  };
  const auto mesh = [&](const std::string& modifier) { return modifier + " mesh m\n1 " + file + "\n0\n0\n"; };
  for (const std::string& refracts :
       {instance("void", "ice"), instance("ice", "gray"), instance("ice", "void"), mesh("ice")}) {
    EXPECT_EQ(shadow(refracts, -10), Shadow::refracted) << refracts;
    EXPECT_EQ(shadow(refracts, 3), Shadow::blocked) << refracts;
  }
  for (const std::string& straight : {instance("void", "pane"), instance("pane", "ice"),
                                      instance("pane", "void"), mesh("pane"), mesh("gray")})
    EXPECT_EQ(shadow(straight, -10), Shadow::blocked) << straight;
}

// One place, several surfaces: the rules of a scene without instances, across them.
TEST(Instances, TiesWithWhatIsBesideThem) {
  const SceneFolder folder;
  const std::string square = " polygon in\n0\n0\n12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n";
  const auto tie = [&](const std::string& inside, const std::string& outside, double from) {
    const std::string oct = folder.octree("tie.oct", std::string(kMaterials) + inside + square);
    const Scene scene = sceneOf(std::string(kMaterials) + "void instance i\n3 " + oct + " -s 2\n0\n0\n" +
                                outside + " polygon out\n0\n0\n12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n");
    const Tracer tracer(scene, true);
    return nameOf(scene, tracer.nearest(V3d(.1, .2, from), V3d(0, 0, -from)));
  };
  EXPECT_EQ(tie("gray", "void", 1), "in");
  EXPECT_EQ(tie("void", "gray", 1), "out");
  EXPECT_EQ(tie("pane", "gray", 1), "out");
  EXPECT_EQ(tie("gray", "pane", 1), "in");
  EXPECT_EQ(tie("gray", "gray", 1), "in");  // read later, as everything in an octree is
}

// ---- meshes

// box.rtm as polygons: the triangles one by one.
std::string polygonsOf(const rad::Mesh& mesh) {
  std::string text = "void plastic gray\n0\n0\n5 .5 .5 .5 0 0\n";
  for (const auto& t : mesh.triangles) {
    text += "gray polygon p\n0\n0\n9";
    for (const uint32_t v : t.vertices) {
      const V3d at = mesh.position(v);
      text += fmt::format(" {} {} {}", at.x, at.y, at.z);
    }
    text += '\n';
  }
  return text;
}

TEST(Meshes, AreHitAsPolygonsAre) {
  const std::string file = std::string(RSPHERE_TESTS) + "/scenes/octree/box.rtm";
  const Scene scene = sceneOf("void mesh m\n1 " + file + "\n0\n0\n");
  const Scene polygons = sceneOf(polygonsOf(scene.meshes[0].data));
  const Tracer tracer(scene, true), flat(polygons, true);
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const V3d from = inBox(random, 4), d = direction(random);
    const Hit a = tracer.nearest(from, d), b = flat.nearest(from, d);
    ASSERT_EQ(a.surface == kNone, b.surface == kNone) << i;
    if (a.surface == kNone) continue;
    ++hits;
    EXPECT_NEAR(a.distance, b.distance, 1e-12 / std::abs(b.cosine));
    EXPECT_LT((a.normal - b.normal).length(), 1e-12);
    EXPECT_NEAR(a.cosine, b.cosine, 1e-12);
    EXPECT_EQ(a.path.count, 1);
    EXPECT_EQ(tracer.shadow(from, d, 10, kNone), Shadow::blocked);
  }
  EXPECT_GT(hits, 500);
}

// No light leaks through a closed hill, however near to its edges and vertices rays pass, wherever it lies.
TEST(Meshes, AreClosedAtTheirEdges) {
  const SceneFolder folder;
  const std::string file = folder.hill("hill.rtm", 20);
  for (const std::string& transform :
       {std::string("-s 1"), std::string("-s .001 -rx 33 -rz 20 -t 100 200 -300")}) {
    const auto words = 2 + std::count(transform.begin(), transform.end(), ' ');
    const Scene scene = sceneOf(fmt::format("void mesh m\n{} {} {}\n0\n0\n", words, file, transform));
    const Tracer tracer(scene, true);
    const rad::Mesh& mesh = scene.meshes[0].data;
    const Placement& placement = scene.placements[0];
    Random random(11);
    for (const auto& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        const V3d a = mesh.position(t.vertices[k]), b = mesh.position(t.vertices[(k + 1) % 3]);
        for (double share : {0., 1e-15, .3, random.uniform()}) {
          const V3d aim = (1 - share) * a + share * b;
          if (aim.x < .01 || aim.y < .01 || aim.x > .98 || aim.y > .98) continue;
          const V3d from =
              placement.toOuter.point(aim + V3d(random.uniform() - .5, random.uniform() - .5, 2));
          const V3d to = placement.toOuter.point(aim);
          const Hit hit = tracer.nearest(from, (to - from).normalized());
          ASSERT_NE(hit.surface, kNone) << aim.x << ' ' << aim.y;
          EXPECT_NEAR(hit.distance, (to - from).length(), .02 * placement.toOuter.scale);
        }
      }
    }
  }
}

TEST(Meshes, OneThousandOfThemTakeTheMemoryOfOne) {
  const SceneFolder folder;
  const std::string file = folder.hill("hill.rtm", 50);
  std::string text;
  for (int i = 0; i < 1000; ++i) text += fmt::format("void mesh m{0}\n5 {1} -t {0} 0 0\n0\n0\n", i, file);
  const Scene scene = sceneOf(text);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].data.triangles.size(), 5000u);
  EXPECT_EQ(scene.surfaces.size(), 1000u);
  const Tracer tracer(scene, true);
  EXPECT_EQ(tracer.primitives(), 1000u + 5000u);
  const Hit hit = tracer.nearest(V3d(777.5, .5, 5), V3d(0, 0, -1));
  ASSERT_NE(hit.surface, kNone);
  EXPECT_EQ(scene.surfaceName(scene.surfaces[hit.surface]), "m777");
}

}  // namespace
}  // namespace rsphere
