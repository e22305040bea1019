#include "scene/scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/constants.h"
#include "scene/material_questions.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

constexpr const char* kGray = "void plastic gray\n0\n0\n5 .5 .5 .5 0 0\n";  // lines 1 to 4

std::string errorOf(const std::string& text) {
  try {
    sceneOf(text);
  } catch (const rad::Error& e) {
    return e.what();
  }
  return "no error";
}

template <class M>
const M& materialAt(const Scene& scene, ModifierId modifier) {
  return std::get<M>(std::get<Material>(scene.modifiers[modifier].content));
}

struct Fault {
  std::string text, message;
};

TEST(Scene, WarnsOfSurfacesWithoutAreaAndLeavesThemOut) {
  const std::vector<Fault> faults = {
      {"gray polygon s\n0\n0\n9 0 0 0 1 0 0 2 0 0\n", "room.rad:5: polygon \"s\": zero area"},
      {"gray cone s\n0\n0\n8 0 0 0 0 0 1 0 0\n", "room.rad:5: cone \"s\": illegal radii"},
      {"gray cone s\n0\n0\n8 0 0 0 0 0 1 1 -1\n", "room.rad:5: cone \"s\": illegal radii"},
      {"gray cone s\n0\n0\n8 0 0 0 0 0 0 1 2\n", "room.rad:5: cone \"s\": unknown orientation"},
      {"gray cylinder s\n0\n0\n7 0 0 0 0 0 1 0\n", "room.rad:5: cylinder \"s\": illegal radii"},
      {"gray cylinder s\n0\n0\n7 1 1 1 1 1 1 1\n", "room.rad:5: cylinder \"s\": unknown orientation"},
      {"gray ring s\n0\n0\n8 0 0 0 0 0 1 1 1\n", "room.rad:5: ring \"s\": illegal radii"},
      {"gray ring s\n0\n0\n8 0 0 0 0 0 1 -1 1\n", "room.rad:5: ring \"s\": illegal radii"},
      {"gray ring s\n0\n0\n8 0 0 0 0 0 0 0 1\n", "room.rad:5: ring \"s\": unknown orientation"},
  };
  for (const Fault& f : faults) {
    std::vector<std::string> warnings;
    const Scene scene = sceneOf(kGray + f.text, &warnings);
    ASSERT_EQ(warnings.size(), 1u) << f.text;
    EXPECT_EQ(warnings[0], f.message);
    EXPECT_TRUE(scene.surfaces.empty());
  }
}

// Rays are traced in single precision. A cone with a radius of 1e308 made answers that are not a number.
TEST(Scene, CoordinatesBeyondSinglePrecisionAreErrors) {
  const std::pair<const char*, const char*> shapes[] = {
      {"polygon", "9 -1e39 0 0 1 0 0 1 1 0"}, {"sphere", "4 0 0 0 1e308"},
      {"cylinder", "7 0 0 -1e300 0 0 4 1"},   {"cone", "8 0 0 0 0 0 1 1 1e308"},
      {"ring", "8 0 0 0 0 0 1 0 3.5e38"},     {"bubble", "4 1e40 0 0 1"},
      {"tube", "7 0 0 0 0 0 1e39 1"},         {"cup", "8 0 0 0 0 0 1 1e39 1"},
  };
  for (const auto& [type, numbers] : shapes) {
    const std::string text = std::string(kGray) + "gray " + type + " s\n0\n0\n" + numbers + "\n";
    try {
      sceneOf(text);
      ADD_FAILURE() << type;
    } catch (const rad::Error& e) {
      EXPECT_NE(std::string(e.what()).find("is too large: coordinates and sizes must be below 3.4e38"),
                std::string::npos)
          << e.what();
    }
  }
  EXPECT_EQ(sceneOf(std::string(kGray) + "gray sphere s\n0\n0\n4 0 0 0 1e30\n").surfaces.size(), 1u);
}

TEST(Scene, SourcesOfNegativeRadianceAreWarnedOf) {
  const std::pair<const char*, const char*> sources[] = {{"light", "3 -1 -1 -1"},
                                                         {"illum", "3 0 -1 0"},
                                                         {"glow", "4 -1 -2 -3 5"},
                                                         {"spotlight", "7 -1 -1 -1 90 0 0 -1"}};
  for (const auto& [type, numbers] : sources) {
    std::vector<std::string> warnings;
    sceneOf(std::string("void ") + type + " l\n0\n0\n" + numbers + "\nl sphere s\n0\n0\n4 0 0 0 1\n" +
                "l sphere t\n0\n0\n4 4 0 0 1\n",
            &warnings);
    ASSERT_EQ(warnings.size(), 1u) << type;
    EXPECT_EQ(warnings[0],
              fmt::format("room.rad:1: {} \"l\": negative radiance: it is seen, but lights nothing", type));
  }
  // A channel above 0 lets the source be sampled, and rays find glow without reach. No light is as usual.
  for (const char* dark :
       {"light l 0 0 3 1 -1 0", "spotlight l 0 0 7 -1 1 1 90 0 0 -1", "glow l 0 0 4 -1 -1 -1 0"}) {
    std::vector<std::string> warnings;
    sceneOf(std::string("void ") + dark + "\nl sphere s\n0\n0\n4 0 0 0 1\n", &warnings);
    ASSERT_EQ(warnings.size(), 1u) << dark;
    EXPECT_NE(warnings[0].find("room.rad:1: "), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[0].find("\"l\": negative radiance: it makes negative light"), std::string::npos)
        << warnings[0];
  }
  std::vector<std::string> warnings;
  sceneOf("void light l 0 0 3 0 0 0\nl sphere s\n0\n0\n4 0 0 0 1\n", &warnings);
  EXPECT_TRUE(warnings.empty());
}

// A message about the arguments says that the type has a reader.
TEST(Scene, ReadsEveryTypeOfSurface) {
  for (int i = 0; i < rad::kTypes; ++i) {
    const auto type = static_cast<rad::Type>(i);
    if (!rad::isSurface(type)) continue;
    const std::string error = errorOf(fmt::format("{}gray {} s\n0\n0\n0\n", kGray, rad::typeName(type)));
    EXPECT_NE(error, "no error") << rad::typeName(type);
    EXPECT_EQ(error.find("not supported"), std::string::npos) << error;
  }
}

TEST(Scene, TurnsNegativeRadiiInsideOutWithAWarning) {
  for (const auto& [type, inward] : {std::pair("sphere", true), {"bubble", false}}) {
    std::vector<std::string> warnings;
    const Scene scene = sceneOf(std::string(kGray) + "gray " + type + " s\n0\n0\n4 0 0 0 -2\n", &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], std::string("room.rad:5: ") + type + " \"s\": negative radius");
    const auto& sphere = *scene.surfaces.at(0).shape.as<Sphere>();
    EXPECT_EQ(sphere.radius, 2);
    EXPECT_EQ(sphere.inward, inward);
  }
  for (const auto& [type, inward] : {std::pair("cylinder", true), {"tube", false}}) {
    std::vector<std::string> warnings;
    const Scene scene =
        sceneOf(std::string(kGray) + "gray " + type + " s\n0\n0\n7 0 0 0 0 0 4 -2\n", &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], std::string("room.rad:5: ") + type + " \"s\": negative radius");
    const auto& cone = *scene.surfaces.at(0).shape.as<Cone>();
    EXPECT_EQ(cone.radius0, 2);
    EXPECT_EQ(cone.radius1, 2);
    EXPECT_EQ(cone.length, 4);
    EXPECT_EQ(cone.inward, inward);
  }
  std::vector<std::string> warnings;
  const Scene scene = sceneOf(std::string(kGray) + "gray cup s\n0\n0\n8 0 0 0 0 0 4 -2 0\n", &warnings);
  EXPECT_EQ(warnings, std::vector<std::string>{"room.rad:5: cup \"s\": negative radii"});
  EXPECT_FALSE(scene.surfaces.at(0).shape.as<Cone>()->inward);
}

TEST(Scene, WarnsOfBentPolygons) {
  std::vector<std::string> warnings;
  sceneOf(std::string(kGray) + "gray polygon s\n0\n0\n12 0 0 0 1 0 0 1 1 .0001 0 1 0\n", &warnings);
  EXPECT_TRUE(warnings.empty()) << "rounding in files is not worth a word";
  sceneOf(std::string(kGray) + "gray polygon s\n0\n0\n12 0 0 0 1 0 0 1 1 .1 0 1 0\n", &warnings);
  EXPECT_EQ(warnings, std::vector<std::string>{"room.rad:5: polygon \"s\": non-planar vertex"});
}

TEST(Scene, RefusesWhatItCannotAnswerRightly) {
  const std::vector<Fault> faults = {
      {"gray sphere s\n0\n0\n4 0 0 0 0\n", "room.rad:5: sphere \"s\": zero radius"},
      {"gray polygon s\n0\n0\n6 0 0 0 1 0 0\n",
       "room.rad:5: polygon \"s\": expected at least 9 coordinates in threes, got 6"},
      {"gray polygon s\n0\n0\n10 0 0 0 1 0 0 1 1 0 1\n",
       "room.rad:5: polygon \"s\": expected at least 9 coordinates in threes, got 10"},
      {"gray sphere s\n0\n0\n3 0 0 0\n", "room.rad:5: sphere \"s\": expected 4 real arguments, got 3"},
      {"gray ring s\n0\n0\n7 0 0 0 0 0 1 1\n", "room.rad:5: ring \"s\": expected 8 real arguments, got 7"},
      {"gray source s\n0\n0\n4 0 0 0 1\n", "room.rad:5: source \"s\": zero direction"},
      {"gray source s\n0\n0\n4 0 0 1 0\n", "room.rad:5: source \"s\": zero size"},
      {"void plastic bad\n0\n0\n4 .5 .5 .5 0\ngray sphere t\n0\n0\n4 0 0 0 1\nbad sphere s\n0\n0\n4 0 0 0 "
       "1\n",
       "room.rad:5: plastic \"bad\": expected 5 real arguments, got 4"},
      {"void dielectric bad\n0\n0\n5 1 1 1 0 0\nbad sphere s\n0\n0\n4 0 0 0 1\n",
       "room.rad:5: dielectric \"bad\": refractive index must be above 0"},
      {"void glass bad\n0\n0\n4 1 1 1 .5\nbad sphere s\n0\n0\n4 0 0 0 1\n",
       "room.rad:5: glass \"bad\": refractive index must be at least 1"},
      {"void spotlight bad\n0\n0\n7 1 1 1 0 0 0 1\nbad sphere s\n0\n0\n4 0 0 0 1\n",
       "room.rad:5: spotlight \"bad\": zero angle"},
      {"void spotlight bad\n0\n0\n7 1 1 1 9 0 0 0\nbad sphere s\n0\n0\n4 0 0 0 1\n",
       "room.rad:5: spotlight \"bad\": zero focus vector"},
      {"void mixfunc bad\n4 later void .5 .\n0\n0\nvoid plastic later\n0\n0\n5 0 0 0 0 0\n"
       "bad sphere s\n0\n0\n4 0 0 0 1\n",
       "room.rad:5: mixfunc \"bad\": undefined modifier \"later\""},
      {"void light l\n0\n0\n3 1 1 1\nl ring s\n0\n0\n8 0 0 0 0 0 1 .5 1\n",
       "room.rad:9: ring \"s\": cannot hit source center"},
      {"void light l\n0\n0\n3 1 1 1\nl bubble s\n0\n0\n4 0 0 0 1\n",
       "room.rad:9: bubble \"s\": a bubble cannot be a light source"},
      {"void light l\n0\n0\n3 1 1 1\nl cone s\n0\n0\n8 0 0 0 0 0 1 1 2\n",
       "room.rad:9: cone \"s\": a cone, cup or tube cannot be a light source"},
      {"void light l\n0\n0\n3 1 1 1\nl polygon s\n0\n0\n"
       "24 0 0 0 3 0 0 3 3 0 2 3 0 2 1 0 1 1 0 1 3 0 0 3 0\n",
       "room.rad:9: polygon \"s\": cannot hit source center"},
  };
  for (const Fault& f : faults) EXPECT_EQ(errorOf(kGray + f.text), f.message);
}

// A reflectance of 60 is one in percent, and light grows with each bounce.
TEST(Scene, WarnsOfMaterialsThatSendOnMoreLightThanArrives) {
  const auto warningsOf = [](const std::string& text) {
    std::vector<std::string> warnings;
    sceneOf(text, &warnings);
    return warnings;
  };
  const auto used = [&](const std::string& material) {
    return warningsOf("void " + material + "\nm sphere s 0 0 4 0 0 0 1\nm sphere t 0 0 4 3 0 0 1\n");
  };
  using List = std::vector<std::string>;
  constexpr std::string_view kWhy = ", so that more light leaves the surface than arrives";
  EXPECT_EQ(used("plastic m 0 0 5 60 50 40 0 0"),
            List{fmt::format("room.rad:1: plastic \"m\": reflectance 60 is above 1{}", kWhy)});
  EXPECT_EQ(used("glass m 0 0 3 .9 1.2 .9"),
            List{fmt::format("room.rad:1: glass \"m\": transmissivity 1.2 is above 1.09{}", kWhy)});
  EXPECT_EQ(used("plastic m 0 0 5 1 1 1 0 0"), List());
  EXPECT_EQ(used("light m 0 0 3 60 60 60"), List());
  EXPECT_EQ(warningsOf("void plastic m 0 0 5 60 60 60 0 0\n"), List()) << "no surface uses it";
  // A pattern may make it less.
  EXPECT_EQ(
      warningsOf("void brightfunc p 2 .1 . 0 0\np texfunc t 4 0 0 0 . 0 0\nt plastic m 0 0 5 2 2 2 0 0\n"
                 "m sphere s 0 0 4 0 0 0 1\n"),
      List());
  EXPECT_EQ(
      warningsOf("void texfunc t 4 0 0 0 . 0 0\nt plastic m 0 0 5 2 2 2 0 0\nm sphere s 0 0 4 0 0 0 1\n")
          .size(),
      1u);
  // Copies of one definition are one warning, another definition is another.
  const std::string paint = "void plastic m 0 0 5 2 2 2 0 0\nm sphere s 0 0 4 0 0 0 1\n";
  EXPECT_EQ(warningsOf(paint + paint).size(), 1u);
  EXPECT_EQ(warningsOf(paint + "void plastic m 0 0 5 3 3 3 0 0\nm sphere s 0 0 4 0 0 0 1\n").size(), 2u);
}

TEST(Scene, NamesTheNearestModifier) {
  EXPECT_EQ(errorOf("void plastic paint 0 0 5 0 0 0 0 0\nvoid mixfunc m 4 paimt void .5 . 0 0\n"
                    "m sphere s 0 0 4 0 0 0 1\n"),
            "room.rad:2: mixfunc \"m\": undefined modifier \"paimt\"; the nearest is \"paint\"");
}

// As in rtrace, where the manual does not say so.
TEST(Scene, AnAlternateThatIsNotDefinedBeforeIsVoid) {
  const auto alternates = [](const std::string& name, std::vector<std::string>* warnings) {
    const Scene scene =
        sceneOf("void plastic paint 0 0 5 0 0 0 0 0\nvoid mirror m 1 " + name +
                    " 0 3 1 1 1\nm sphere s 0 0 4 0 0 0 1\nvoid illum i 1 " + name +
                    " 0 3 1 1 1\ni sphere t 0 0 4 3 0 0 1\nvoid plastic later 0 0 5 0 0 0 0 0\n",
                warnings);
    std::vector<Alternate::Kind> kinds;
    for (const SurfaceId i : scene.surfaces.ids())
      kinds.push_back(alternateOf(*scene.materialOf(scene.surfaces[i]))->kind);
    return kinds;
  };
  using enum Alternate::Kind;
  for (const char* name : {"void", "later", "paimt"}) {
    std::vector<std::string> warnings;
    EXPECT_EQ(alternates(name, &warnings), (std::vector{pass, pass})) << name;
    const std::string hint = name == std::string("paimt") ? "; the nearest is \"paint\"" : "";
    std::vector<std::string> expected;
    if (name != std::string("void"))
      expected = {
          fmt::format("room.rad:2: mirror \"m\": undefined modifier \"{}\" is treated as void{}", name, hint),
          fmt::format("room.rad:4: illum \"i\": undefined modifier \"{}\" is treated as void{}", name, hint)};
    EXPECT_EQ(warnings, expected);
  }
  EXPECT_EQ(alternates("paint", nullptr), (std::vector{modifier, modifier}));
}

TEST(Scene, LooksAtUsedModifiersOnly) {
  const Scene scene = sceneOf(
      "void plastic unused\n0\n0\n1 7\n"
      "void plastic a\n0\n0\n5 .1 .2 .3 .04 .05\n"
      "a sphere s\n0\n0\n4 0 0 0 1\n"
      "a sphere t\n0\n0\n4 5 0 0 1\n");
  ASSERT_EQ(scene.modifiers.size(), 1u) << "the same modifier is converted once";
  const auto& plastic = materialAt<Opaque>(scene, ModifierId(0));
  EXPECT_EQ(plastic.color, Color(.1, .2, .3));
  EXPECT_EQ(plastic.specularity, .04);
  EXPECT_EQ(plastic.roughness, .05);
  EXPECT_FALSE(plastic.metal);
  EXPECT_EQ(scene.surfaces.at(1).modifier, ModifierId(0));
}

TEST(Scene, FollowsAliasesAndRedefinitions) {
  const Scene scene = sceneOf(
      "void plastic a\n0\n0\n5 .1 .1 .1 0 0\n"
      "void alias b a\n"
      "void plastic a\n0\n0\n5 .2 .2 .2 0 0\n"
      "a sphere second\n0\n0\n4 0 0 0 1\n"
      "b sphere first\n0\n0\n4 5 0 0 1\n"
      "void sphere none\n0\n0\n4 9 0 0 1\n");
  ASSERT_EQ(scene.surfaces.size(), 3u);
  const auto red = [&](int i) { return materialAt<Opaque>(scene, scene.surfaces.at(i).material).color.x; };
  EXPECT_EQ(red(0), .2);
  EXPECT_EQ(red(1), .1);
  EXPECT_EQ(scene.surfaceName(scene.surfaces.at(1)), "first");
  EXPECT_EQ(scene.modifierName(scene.surfaces.at(1)), "b");
  EXPECT_EQ(scene.materialName(scene.surfaces.at(1)), "a");
  EXPECT_EQ(scene.surfaces.at(2).modifier, kNone);
  EXPECT_EQ(scene.modifierName(scene.surfaces.at(2)), "void");
  EXPECT_EQ(scene.materialName(scene.surfaces.at(2)), "void");
}

TEST(Scene, NamesSurfacesInSmallAndLargeScenes) {
  for (const size_t count : {size_t{3}, Scene::kFewSurfaces, Scene::kFewSurfaces + 1}) {
    std::string text = std::string(kGray) + "gray ring leftOut\n0\n0\n8 0 0 0 0 0 1 1 1\n";
    for (size_t i = 0; i < count; ++i) text += fmt::format("gray sphere s{}\n0\n0\n4 {} 0 0 1\n", i, i);
    std::vector<std::string> warnings;
    const Scene scene = sceneOf(text, &warnings);
    ASSERT_EQ(scene.surfaces.size(), count);
    EXPECT_EQ(scene.names.size(), count <= Scene::kFewSurfaces ? count : 0);
    for (const size_t i : {size_t{0}, count / 2, count - 1})
      EXPECT_EQ(scene.surfaceName(scene.surfaces.at(i)), fmt::format("s{}", i));
  }
}

TEST(Scene, ReadsAlternatesOfMirrorAndIllum) {
  const Scene scene = sceneOf(
      "void glass pane\n0\n0\n3 .9 .9 .9\n"
      "void illum i0\n0\n0\n3 1 1 1\nvoid illum i1\n1 void\n0\n3 1 1 1\nvoid illum i2\n1 pane\n0\n3 1 1 1\n"
      "i0 sphere a\n0\n0\n4 0 0 0 1\ni1 sphere b\n0\n0\n4 0 0 0 1\ni2 sphere c\n0\n0\n4 0 0 0 1\n");
  const auto alternate = [&](int i) {
    return materialAt<Illum>(scene, scene.surfaces.at(i).material).alternate;
  };
  EXPECT_EQ(alternate(0).kind, Alternate::Kind::none);
  EXPECT_EQ(alternate(1).kind, Alternate::Kind::pass);
  ASSERT_EQ(alternate(2).kind, Alternate::Kind::modifier);
  EXPECT_EQ(materialAt<Glass>(scene, alternate(2).modifier).transmissivity.x, .9);
}

TEST(Scene, MeasuresCones) {
  const Scene scene = sceneOf(
      "void spotlight s\n0\n0\n7 1 1 1 60 0 0 -2\ns sphere a\n0\n0\n4 0 0 0 1\n"
      "void light sun\n0\n0\n3 1 1 1\nsun source b\n0\n0\n4 0 0 2 .533\nsun source c\n0\n0\n4 0 1 0 180\n");
  const auto& spot = materialAt<Spotlight>(scene, scene.surfaces.at(0).material);
  EXPECT_NEAR(spot.solidAngle, 2 * kPi * (1 - std::cos(kPi / 6)), 1e-14);
  EXPECT_EQ(spot.aim, V3d(0, 0, -1));
  EXPECT_EQ(spot.focalLength, 2);
  const auto& sun = *scene.surfaces.at(1).shape.as<Distant>();
  EXPECT_EQ(sun.direction, V3d(0, 0, 1));
  const double w = .533 * kPi / 180;
  EXPECT_NEAR(sun.solidAngle, kPi * w * w / 4 * (1 - w * w / 48), 1e-14);
  EXPECT_NEAR(scene.surfaces.at(2).shape.as<Distant>()->solidAngle, 2 * kPi, 1e-14);
}

TEST(Scene, DropsALastVertexThatRepeatsTheFirst) {
  const Scene scene =
      sceneOf(std::string(kGray) + "gray polygon s\n0\n0\n15 0 0 0 1 0 0 1 1 0 0 1 0 0 0 0\n");
  EXPECT_EQ(scene.surfaces.at(0).shape.as<Polygon>()->vertices, 4u);
}

TEST(Scene, TakesChainsOfAnyDepth) {
  std::string text = "void plastic m\n0\n0\n5 .5 .5 .5 0 0\n";
  for (int i = 0; i < 50000; ++i) text += "m plastic m\n0\n0\n5 .5 .5 .5 0 0\n";
  EXPECT_EQ(sceneOf(text + "m sphere s\n0\n0\n4 0 0 0 1\n").modifiers.size(), 50001u);
}

}  // namespace
}  // namespace rsphere
