#include "silhouettes/special_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "silhouettes/tuning.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

const Color kGray(.5, .5, .5);

std::vector<std::string> namesOf(const Scene& scene, const std::vector<SpecialObject>& objects) {
  std::vector<std::string> names;
  for (const SpecialObject& o : objects) names.emplace_back(scene.surfaceName(scene.surfaces[o.surface]));
  return names;
}

TEST(Irregularity, ByType) {
  EXPECT_EQ(irregularity(Mirror{kGray, {}}), 1);
  EXPECT_EQ(irregularity(Dielectric{kGray, 1.5, 0}), 1);
  EXPECT_EQ(irregularity(Interface{kGray, 1.5, kGray, 1.3}), 1);
  EXPECT_EQ(irregularity(Glass{kGray, 1.52}), tuning::SpecialObjects::kPane);
  EXPECT_EQ(irregularity(BsdfMaterial{.aperture = true}), 1);
  EXPECT_EQ(irregularity(BsdfMaterial{.proxy = true}), 0);
  EXPECT_EQ(irregularity(Light{kGray}), 0);
  EXPECT_EQ(irregularity(Illum{kGray, {}}), 0);
  EXPECT_EQ(irregularity(Glow{kGray, 0}), 0);
  EXPECT_EQ(irregularity(Spotlight{}), 0);
}

TEST(Irregularity, BySpecularityAndRoughness) {
  EXPECT_EQ(irregularity(Opaque{kGray, 0, 0, false}), 0);
  EXPECT_EQ(irregularity(Opaque{kGray, .9, 0, true}), .9);
  EXPECT_EQ(irregularity(Opaque{kGray, .8, tuning::SpecialObjects::kSharpRoughness, true}), .4);
  EXPECT_EQ(irregularity(Trans{kGray, .1, 0, .5, .8}), .9 * .5 * .8);
  EXPECT_EQ(irregularity(Trans{kGray, .3, 0, .1, .1}), .3);
  // More specular is more irregular, rougher is less.
  for (double rough = 0; rough < .5; rough += .05)
    for (double specular = 0; specular < .9; specular += .1) {
      const double here = irregularity(Opaque{kGray, specular, rough, false});
      EXPECT_LT(here, irregularity(Opaque{kGray, specular + .1, rough, false}));
      EXPECT_GE(here, irregularity(Opaque{kGray, specular, rough + .05, false}));
    }
}

TEST(Irregularity, OfEllipticHighlightsByBothRoughnesses) {
  const auto shiny = [](double specular, double along, double across) {
    return irregularity(Anisotropic{kGray, specular, along, across});
  };
  EXPECT_NEAR(shiny(.8, tuning::SpecialObjects::kSharpRoughness, tuning::SpecialObjects::kSharpRoughness), .4,
              1e-12)
      << "as its round kin";
  EXPECT_NEAR(shiny(.8, .2, .01), shiny(.8, .01, .2), 1e-12);
  EXPECT_GT(shiny(.8, .2, .01), shiny(.8, .2, .1));
  EXPECT_LT(shiny(.8, .2, .01), shiny(.8, .01, .01));
  Anisotropic through{kGray, 0, tuning::SpecialObjects::kSharpRoughness,
                      tuning::SpecialObjects::kSharpRoughness};
  through.transmissivity = .5;
  through.transmittedSpecular = .8;
  EXPECT_NEAR(irregularity(through), .2, 1e-12);
  const auto phong = [](double power) { return irregularity(Ashikhmin{kGray, kGray, power, power}); };
  EXPECT_NEAR(
      phong(2 / (tuning::SpecialObjects::kSharpRoughness * tuning::SpecialObjects::kSharpRoughness) - 1), .25,
      1e-12);
  EXPECT_LT(phong(5), phong(50));
}

// What functions decide is taken for as irregular as it may be, numbers for what they are.
TEST(Irregularity, OfFunctionsByWhatIsKnown) {
  const auto of = [](const std::string& material) {
    const Scene scene = sceneOf(material + "\nM sphere s 0 0 4 0 0 0 1\n");
    return irregularity(*scene.materialOf(scene.surfaces.at(0)));
  };
  EXPECT_EQ(of("void plasfunc M 2 f . 0 4 .5 .5 .5 .2"), .1) << "of unknown width: half of a sharp one";
  EXPECT_EQ(of("void metdata M 4 f d.dat . x 0 4 .5 .5 .5 0"), 0);
  EXPECT_NEAR(of("void transfunc M 2 f . 0 6 .5 .5 .5 .1 .5 .8"), .9 * .5 * .8 / 2, 1e-12);
  EXPECT_EQ(of("void BRTDfunc M 10 0 0 0 0 0 0 0 0 0 . 0 9 .1 .1 .1 0 0 0 0 0 0"), 0);
  EXPECT_EQ(of("void BRTDfunc M 10 0 0 0 0 0 0 f f f . 0 9 .1 .1 .1 0 0 0 0 0 0"), .5);
  EXPECT_EQ(of("void BRTDfunc M 10 .1 .2 .1 0 .3 0 0 0 0 . 0 9 .1 .1 .1 0 0 0 0 0 0"), .3);
  EXPECT_EQ(of("void BRTDfunc M 10 Rdot .2 .1 0 .3 0 0 0 0 . 0 9 .1 .1 .1 0 0 0 0 0 0"), 1);
  const std::string nine = " . 0 9 .1 .1 .1 0 0 0 0 0 0";
  EXPECT_EQ(of("void WGMDfunc M 13 void 0 0 0 void 0 0 0 void 0 0 1" + nine), 0);
  EXPECT_EQ(of("void WGMDfunc M 13 void .2 0 0 void .4 .0065 .0065 void 0 0 1" + nine), .2);
  EXPECT_EQ(of("void WGMDfunc M 13 void Rdot 0 0 void .4 .0065 .0065 void 0 0 1" + nine), 1);
  EXPECT_EQ(of("void WGMDfunc M 13 void .2 .0065 Rdot void 0 0 0 void 0 0 1" + nine), .2 / std::sqrt(2));
}

constexpr const char* kRoom =
    "void plastic matt 0 0 5 .5 .5 .5 0 0\n"
    "void metal chrome 0 0 5 .8 .8 .8 .9 0\n"
    "void alias tin chrome\n"
    "void alias foil tin\n"
    "void mirror silver 0 0 3 .9 .9 .9\n"
    "void light lamp 0 0 3 1 1 1\n"
    "matt sphere wall 0 0 4 0 0 0 9\n"
    "chrome sphere ball 0 0 4 1 0 0 1\n"
    "foil sphere wrapped 0 0 4 2 0 0 1\n"
    "lamp sphere bulb 0 0 4 3 0 0 1\n"
    "silver polygon glassless 0 0 9 0 0 0 1 0 0 0 1 0\n"
    "void sphere bare 0 0 4 4 0 0 1\n"
    "lamp source sun 0 0 4 0 0 1 .5\n";

TEST(SpecialObjects, AreFoundThroughAliases) {
  const Scene scene = sceneOf(kRoom);
  const auto objects = findSpecialObjects(scene, 1);
  EXPECT_EQ(namesOf(scene, objects), (std::vector<std::string>{"ball", "wrapped", "glassless"}));
  for (const SpecialObject& o : objects)
    EXPECT_EQ(o.density, o.irregularity * tuning::SpecialObjects::kDirectionsPerSr);
  EXPECT_EQ(objects[1].irregularity, .9);
  EXPECT_EQ(objects[2].irregularity, 1);
}

// An illum is seen as its alternate material, or not at all.
TEST(SpecialObjects, IllumsAreWhatTheyShow) {
  const Scene scene = sceneOf(
      "void glass clear 0 0 3 .9 .9 .9\nvoid metal steel 0 0 5 .8 .8 .8 .9 0\n"
      "void plastic gray 0 0 5 .5 .5 .5 0 0\n"
      "void illum window 1 clear 0 3 5 5 5\nvoid illum hole 1 void 0 3 5 5 5\n"
      "void illum plate 1 steel 0 3 5 5 5\n"
      "void illum wall 1 gray 0 3 5 5 5\n"
      "window ring a 0 0 8 0 0 1 0 0 1 0 1\nhole ring b 0 0 8 0 0 2 0 0 1 0 1\n"
      "plate ring c 0 0 8 0 0 3 0 0 1 0 1\nwall ring d 0 0 8 0 0 4 0 0 1 0 1\n");
  const auto objects = findSpecialObjects(scene, 1);
  EXPECT_EQ(namesOf(scene, objects), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(objects[0].irregularity, tuning::SpecialObjects::kPane);
  EXPECT_EQ(objects[1].irregularity, tuning::SpecialObjects::kPane);
  EXPECT_GT(objects[2].irregularity, tuning::SpecialObjects::kPane);
}

TEST(SpecialObjects, DensityIsMultiplied) {
  const Scene scene = sceneOf(kRoom);
  const auto once = findSpecialObjects(scene, 1), thrice = findSpecialObjects(scene, 3);
  ASSERT_EQ(once.size(), thrice.size());
  for (size_t i = 0; i < once.size(); ++i) EXPECT_EQ(thrice[i].density, 3 * once[i].density);
}

TEST(SpecialObjects, NoneInADiffuseScene) {
  const Scene scene = sceneOf(
      "void plastic matt 0 0 5 .5 .5 .5 0 0\nvoid plastic satin 0 0 5 .5 .5 .5 .03 .2\n"
      "matt sphere a 0 0 4 0 0 0 1\nsatin sphere b 0 0 4 2 0 0 1\n");
  EXPECT_TRUE(findSpecialObjects(scene, 1).empty());
  EXPECT_EQ(specialObjectsText(scene, {}), "");
}

TEST(SpecialObjects, TextHasALineForEach) {
  const Scene scene = sceneOf(kRoom);
  const auto objects = findSpecialObjects(scene, 1);
  const std::string text = specialObjectsText(scene, objects);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  const auto has = [&](const char* words) { return text.find(words) != std::string::npos; };
  EXPECT_TRUE(
      has("room.rad:8: sphere \"ball\"\tmetal \"chrome\"\t28800 per sr\tspecularity 0.9, roughness 0"))
      << text;
  EXPECT_TRUE(has("room.rad:11: polygon \"glassless\"\tmirror \"silver\"\t32000 per sr\tirregular by type"))
      << text;
  EXPECT_TRUE(has("sphere \"wrapped\"\tmetal \"chrome\"")) << text;
}

}  // namespace
}  // namespace rsphere
