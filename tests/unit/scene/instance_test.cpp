#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/support/files_of.h"
#include "tests/unit/support/scene_of.h"

// Octrees and meshes that a scene brings in: what is read, how often, and what is refused.
namespace rsphere::instance_test {
namespace {

constexpr const char* kGray = "void plastic gray\n0\n0\n5 .5 .5 .5 0 0\n";
constexpr const char* kBall = "gray sphere ball\n0\n0\n4 0 0 0 1\n";

std::string instance(const std::string& octree, const std::string& transform = "0",
                     const std::string& modifier = "void", const std::string& type = "instance") {
  const auto words = static_cast<int>(std::count(transform.begin(), transform.end(), ' ')) + 1;
  return modifier + " " + type + " placed\n" +
         (transform == "0" ? "1 " + octree : std::to_string(words + 1) + " " + octree + " " + transform) +
         "\n0\n0\n";
}

std::string fault(const std::string& text, rad::Status status = rad::Status::input) {
  try {
    sceneOf(text);
  } catch (const rad::Error& error) {
    EXPECT_EQ(error.status(), status);
    return error.what();
  }
  return {};
}

TEST(Instances, AnOctreeIsThereOnceHoweverOftenItIsNamed) {
  const SceneFolder folder;
  const std::string oct =
      folder.octree("a.oct", std::string(kGray) + kBall + "gray ring lid\n0\n0\n8 0 0 2 0 0 1 0 1\n");
  std::string text = kGray;
  for (int i = 0; i < 1000; ++i) text += instance(oct, "-s 2 -t " + std::to_string(3 * i) + " 0 0");
  const Scene scene = sceneOf(text);
  ASSERT_EQ(scene.groups.size(), 2u);
  EXPECT_EQ(scene.outermost().size(), 1000u);
  EXPECT_EQ(scene.surfaces.size(), 1002u);
  EXPECT_EQ(scene.placements.size(), 1000u);
  EXPECT_EQ(scene.surfaceName(scene.surfaces.at(1001)), "lid");
  EXPECT_EQ(scene.modifierName(scene.surfaces.at(1001)), "gray");
  EXPECT_EQ(scene.modifierName(scene.surfaces.at(7)), "void");
  const Placement& p = scene.placements[2];
  EXPECT_EQ(p.toOuter.point(V3d(1, 0, 0)), V3d(8, 0, 0));
  EXPECT_EQ(p.toInner.point(V3d(8, 0, 0)), V3d(1, 0, 0));
}

TEST(Instances, PlacesSayWhichFileBroughtTheOctreeIn) {
  const SceneFolder folder;
  const std::string oct = folder.octree("a.oct", std::string(kGray) + "gray sphere ball\n0\n0\n4 0 0 0 0\n");
  EXPECT_EQ(fault("# a comment\n" + instance(oct)),
            oct + ".rad:5 (from " + oct + ", room.rad:2): sphere \"ball\": zero radius");
}

TEST(Instances, MirrorsTakeNormalsAlong) {
  const SceneFolder folder;
  const Scene scene = sceneOf(instance(folder.octree("a.oct", std::string(kGray) + kBall), "-mx -s 2"));
  const Placement& p = scene.placements[0];
  EXPECT_EQ(p.toOuter.scale, 2);
  EXPECT_EQ(p.toInner.scale, .5);
  EXPECT_EQ(p.directionToOuter(V3d(1, 0, 0)), V3d(-1, 0, 0));
  EXPECT_EQ(p.directionToInner(V3d(0, 1, 0)), V3d(0, 1, 0));
}

TEST(Instances, PlacementsWithinEachOther) {
  const SceneFolder folder;
  const std::string inner = folder.octree("inner.oct", std::string(kGray) + kBall);
  const std::string outer = folder.octree("outer.oct", instance(inner, "-t 1 0 0 -rz 90"));
  const Scene scene = sceneOf(instance(outer, "-s 3 -t 0 0 5"));
  ASSERT_EQ(scene.groups.size(), 3u);
  PlacementPath path;
  path.count = 2;
  path.placements[0] = 0;
  path.placements[1] = 1;
  const Placement all = scene.placementOf(path);
  EXPECT_LT((all.toOuter.point(V3d(1, 0, 0)) - V3d(0, 6, 5)).length(), 1e-14);
  EXPECT_LT((all.toInner.point(V3d(0, 6, 5)) - V3d(1, 0, 0)).length(), 1e-14);
  EXPECT_EQ(all.toOuter.scale, 3);
  EXPECT_EQ(scene.placementOf({}).toOuter.point(V3d(1, 2, 3)), V3d(1, 2, 3));
}

TEST(Instances, WithinThemselvesAreRefused) {
  const SceneFolder folder;
  const std::string a = folder.path("a.oct");
  folder.octree("b.oct", instance(a));
  folder.octree("a.oct", instance(folder.path("b.oct")));
  EXPECT_TRUE(fault(instance(a)).ends_with("instance \"placed\": an octree contains itself"))
      << fault(instance(a));
}

TEST(Instances, GoSixteenDeep) {
  const SceneFolder folder;
  std::string oct = folder.octree("0.oct", std::string(kGray) + kBall);
  for (int i = 1; i < 16; ++i) oct = folder.octree(std::to_string(i) + ".oct", instance(oct, "-t 1 0 0"));
  EXPECT_EQ(fault(instance(oct)), "");
  oct = folder.octree("16.oct", instance(oct));
  EXPECT_TRUE(fault(instance(oct)).ends_with("octrees are nested more than 16 deep"));
}

TEST(Instances, DistantSourcesInOctreesAreLeftOut) {
  const SceneFolder folder;
  const std::string oct =
      folder.octree("a.oct", std::string(kGray) +
                                 "void light sun\n0\n0\n3 1 1 1\nsun source far\n0\n0\n4 0 0 1 1\n" + kBall);
  const Scene scene = sceneOf(instance(oct));
  EXPECT_EQ(scene.groups[1].surfaces.size(), 1u);
}

TEST(Instances, WhatIsWrongWithThem) {
  const SceneFolder folder;
  const std::string oct = folder.octree("a.oct", std::string(kGray) + kBall);
  EXPECT_EQ(fault("void instance a\n0\n0\n0\n"), "room.rad:1: instance \"a\": expected a file name");
  EXPECT_EQ(fault(instance(oct, "-t 1 2")), "room.rad:1: instance \"placed\": bad transform");
  EXPECT_EQ(fault(instance(oct, "-s 1e-200")),
            "room.rad:1: instance \"placed\": the transform exceeds the range of numbers");
  EXPECT_EQ(fault(instance("none.oct"), rad::Status::system), "none.oct: cannot find octree file" +
                                                                  rad::FileAccess().remark("none.oct", true) +
                                                                  " (from room.rad:1: instance \"placed\")");
  EXPECT_EQ(fault(instance("none.rtm", "0", "void", "mesh"), rad::Status::system),
            "none.rtm: cannot find mesh file" + rad::FileAccess().remark("none.rtm", true) +
                " (from room.rad:1: mesh \"placed\")");
  for (const char* light : {"void light lamp\n0\n0\n3 1 1 1\n", "void glow lamp\n0\n0\n4 1 1 1 5\n"}) {
    std::vector<std::string> warnings;
    sceneOf(light + instance(oct, "0", "lamp"), &warnings);
    EXPECT_EQ(warnings,
              std::vector<std::string>{"room.rad:5: instance \"placed\": a surface of this type is no "
                                       "light source: it is seen, but lights nothing"});
  }
}

TEST(Meshes, TrianglesOfEachMaterialAreASurface) {
  const std::string file = std::string(RSPHERE_TESTS) + "/scenes/octree/box.rtm";
  const std::string text =
      std::string(kGray) + instance(file, "-s 2", "void", "mesh") + instance(file, "0", "gray", "mesh");
  const Scene scene = sceneOf(text);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.outermost().size(), 2u);
  ASSERT_EQ(scene.meshes[0].facesOf.size(), 2u);
  const Surface& brick = scene.surfaces[scene.meshes[0].facesOf[0]];
  EXPECT_EQ(scene.surfaceName(brick), "M-Tri");
  EXPECT_EQ(scene.modifierName(brick), "brick");
  EXPECT_EQ(scene.materialName(brick), "brick");
  EXPECT_EQ(scene.modifierName(scene.surfaces.at(1)), "gray");
  EXPECT_EQ(scene.place(brick), file + ": object 1 (from room.rad:5): mesh \"M-Tri\"");
}

// A material of a mesh that no triangle has is not looked at: it may be of a type that is not supported.
TEST(Meshes, OnlyTheMaterialsThatAreUsedAreConverted) {
  const SceneFolder folder;
  const Scene scene = sceneOf(instance(folder.hill("hill.rtm", 3), "0", "void", "mesh"));
  EXPECT_TRUE(scene.modifiers.empty());
  EXPECT_EQ(scene.surfaces.size(), 1u);
  EXPECT_EQ(scene.meshes[0].data.triangles.size(), 18u);
}

}  // namespace
}  // namespace rsphere::instance_test
