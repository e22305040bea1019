#include "scene/material_questions.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

constexpr double kGreenish =
    .5 * kRedWeight + .6 * kGreenWeight + .7 * kBlueWeight;  // brightness of .5 .6 .7

// A material as a scene file defines it, and its answers.
struct Row {
  std::string type, arguments;
  bool transparent = false;
  Sides stops{};
  bool boundary = false, encloses = false;
  std::optional<Alternate::Kind> alternate{};
  bool source = false, sampled = false;
  double reach = 0;
  Cover cover = Cover::hides;
  int images = 0;
  std::optional<MirrorReflection> mirrors{};
  std::optional<double> diffuse{};  // share
};

constexpr Sides kFront{true, false}, kBoth{true, true};
constexpr auto kWithout = Alternate::Kind::none, kPass = Alternate::Kind::pass,
               kOther = Alternate::Kind::modifier;

MirrorReflection clear(int boundaries) { return {.boundaries = boundaries}; }

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {.type = "plastic",
       .arguments = "0 0 5 .5 .6 .7 .1 .02",
       .stops = kFront,
       .mirrors = MirrorReflection{.1, .1, .02},
       .diffuse = .9},
      {.type = "metal",
       .arguments = "0 0 5 .5 .6 .7 .8 0",
       .stops = kFront,
       .mirrors = MirrorReflection{.8, .8 * kGreenish, 0},
       .diffuse = 1 - .8},
      {.type = "trans",
       .arguments = "0 0 7 .5 .6 .7 .1 .02 .5 .25",
       .transparent = true,
       .mirrors = MirrorReflection{.1, .1, .02}},
      {.type = "plastic2", .arguments = "4 1 0 0 . 0 6 .5 .6 .7 .1 .1 .2", .stops = kBoth},
      {.type = "metal2", .arguments = "4 1 0 0 . 0 6 .5 .6 .7 .1 .1 .2", .stops = kBoth},
      {.type = "trans2",
       .arguments = "4 1 0 0 . 0 8 .5 .6 .7 .1 .1 .2 .5 .5",
       .transparent = true,
       .stops = kBoth},
      {.type = "ashik2", .arguments = "4 1 0 0 . 0 8 .5 .6 .7 .1 .1 .1 50 60", .stops = kBoth},
      {.type = "plasfunc", .arguments = "2 f . 0 4 .5 .6 .7 .1", .stops = kBoth},
      {.type = "metfunc", .arguments = "2 f . 0 4 .5 .6 .7 .1", .stops = kBoth},
      {.type = "transfunc", .arguments = "2 f . 0 6 .5 .6 .7 .1 .5 .5", .stops = kBoth},
      {.type = "plasdata", .arguments = "4 f d . x 0 4 .5 .6 .7 .1", .stops = kBoth},
      {.type = "metdata", .arguments = "4 f d . x 0 4 .5 .6 .7 .1", .stops = kBoth},
      {.type = "transdata", .arguments = "4 f d . x 0 6 .5 .6 .7 .1 .5 .5", .stops = kBoth},
      {.type = "BRTDfunc", .arguments = "10 .1 .1 .1 0 0 0 0 0 0 . 0 9 1 1 1 1 1 1 0 0 0", .stops = kBoth},
      {.type = "BRTDfunc",
       .arguments = "10 .1 .1 .1 0 t 0 0 0 0 . 0 9 1 1 1 1 1 1 0 0 0",
       .transparent = true},
      {.type = "WGMDfunc",
       .arguments = "13 void .1 .1 .1 void 0 0 0 void 1 0 0 . 0 9 1 1 1 1 1 1 0 0 0",
       .stops = kBoth},
      {.type = "WGMDfunc",
       .arguments = "13 void .1 .1 .1 void .2 0 0 void 1 0 0 . 0 9 1 1 1 1 1 1 0 0 0",
       .transparent = true},
      {.type = "BSDF", .arguments = "6 0 a.xml 0 0 1 . 0 0"},
      {.type = "BSDF", .arguments = "6 .1 a.xml 0 0 1 . 0 0", .transparent = true},
      {.type = "aBSDF", .arguments = "5 a.xml 0 0 1 . 0 0", .transparent = true},
      {.type = "dielectric",
       .arguments = "0 0 5 .5 .6 .7 1.5 0",
       .transparent = true,
       .boundary = true,
       .mirrors = clear(1)},
      {.type = "interface",
       .arguments = "0 0 8 .5 .6 .7 1.5 1 1 1 1",
       .transparent = true,
       .boundary = true,
       .mirrors = clear(1)},
      {.type = "glass", .arguments = "0 0 3 .5 .6 .7", .transparent = true, .mirrors = clear(2)},
      {.type = "mirror",
       .arguments = "0 0 3 .5 .6 .7",
       .stops = kFront,
       .alternate = kWithout,
       .images = 1,
       .mirrors = MirrorReflection{.7, kGreenish, 0, 0, true}},
      {.type = "mirror",
       .arguments = "1 void 0 3 .5 .6 .7",
       .alternate = kPass,
       .images = 1,
       .mirrors = MirrorReflection{.7, kGreenish, 0, 0, true}},
      {.type = "mirror",
       .arguments = "1 gray 0 3 .5 .6 .7",
       .alternate = kOther,
       .images = 1,
       .mirrors = MirrorReflection{.7, kGreenish, 0, 0, true}},
      {.type = "prism1", .arguments = "5 1 0 0 1 . 0 0", .stops = kBoth, .images = 1},
      {.type = "prism2", .arguments = "9 1 0 0 1 1 0 0 1 . 0 0", .stops = kBoth, .images = 2},
      {.type = "antimatter", .arguments = "1 void 0 0", .encloses = true, .alternate = kPass},
      {.type = "antimatter", .arguments = "1 gray 0 0", .encloses = true, .alternate = kOther},
      {.type = "mist", .arguments = "0 0 3 .1 .1 .1", .transparent = true, .encloses = true},
      {.type = "light", .arguments = "0 0 3 5 6 7", .stops = kBoth, .source = true, .sampled = true},
      {.type = "light", .arguments = "0 0 3 0 0 0", .stops = kBoth, .source = true},
      {.type = "illum",
       .arguments = "0 0 3 5 6 7",
       .alternate = kWithout,
       .source = true,
       .sampled = true,
       .cover = Cover::passes},
      {.type = "illum",
       .arguments = "1 void 0 3 5 6 7",
       .alternate = kPass,
       .source = true,
       .sampled = true,
       .cover = Cover::passes},
      {.type = "illum",
       .arguments = "1 gray 0 3 5 6 7",
       .alternate = kOther,
       .source = true,
       .sampled = true},
      {.type = "glow",
       .arguments = "0 0 4 5 6 7 2",
       .stops = kBoth,
       .source = true,
       .sampled = true,
       .reach = 2,
       .cover = Cover::yields},
      {.type = "glow", .arguments = "0 0 4 5 6 7 0", .stops = kBoth, .source = true, .cover = Cover::yields},
      {.type = "glow",
       .arguments = "0 0 4 5 6 7 -1",
       .stops = kBoth,
       .source = true,
       .reach = -1,
       .cover = Cover::yields},
      {.type = "spotlight",
       .arguments = "0 0 7 5 6 7 30 0 0 -1",
       .stops = kBoth,
       .source = true,
       .sampled = true},
  };
  return all;
}

Material materialOf(const Row& row) {
  const Scene scene = sceneOf("void plastic gray 0 0 5 .5 .5 .5 0 0\nvoid " + row.type + " m " +
                              row.arguments + "\nm polygon s 0 0 9 0 0 0 1 0 0 0 1 0\n");
  return *scene.materialOf(scene.surfaces.at(0));
}

// The rows above have arguments of at most 1: none has an excess.
TEST(MaterialQuestions, ExcessIsTheFirstArgumentThatIsTooLarge) {
  struct Case {
    std::string type, arguments;
    std::string_view argument;
    double value = 0, most = 1;
  };
  const std::vector<Case> cases = {
      {"plastic", "0 0 5 .5 1.1 .7 0 0", "reflectance", 1.1},
      {"metal", "0 0 5 .5 .5 .5 1.2 0", "specularity", 1.2},
      {"trans", "0 0 7 .5 .5 1.5 0 0 .5 .5", "reflectance", 1.5},
      {"trans", "0 0 7 .5 .5 .5 0 0 2 .5", "transmissivity", 2},
      {"plastic2", "4 1 0 0 . 0 6 9 .5 .5 .1 .1 .1", "reflectance", 9},
      {"trans2", "4 1 0 0 . 0 8 .5 .6 .7 .1 .1 .2 3 .5", "transmissivity", 3},
      {"ashik2", "4 1 0 0 . 0 8 .5 .6 .7 .1 .1 4 50 60", "reflectance", 4},
      {"metfunc", "2 f . 0 4 .5 .6 5 .1", "reflectance", 5},
      {"transdata", "4 f d . x 0 6 .5 .6 .7 .1 6 .5", "transmissivity", 6},
      {"BRTDfunc", "10 .1 .1 .1 0 0 0 0 0 0 . 0 9 1 1 1 1 7 1 0 0 0", "reflectance", 7},
      {"BRTDfunc", "10 .1 .1 .1 0 0 0 0 0 0 . 0 9 1 1 1 1 1 1 0 0 8", "transmissivity", 8},
      {"BSDF", "6 0 a.xml 0 0 1 . 0 3 2 2 2", "reflectance", 2},
      {"dielectric", "0 0 5 .5 .6 1.7 1.5 0", "transmissivity", 1.7},
      {"interface", "0 0 8 .5 .6 .7 1.5 1 1 1.3 1", "transmissivity", 1.3},
      {"glass", "0 0 3 .9 .9 1.2", "transmissivity", 1.2, 1.089},
      {"glass", "0 0 4 1.05 1 1 1", "transmissivity", 1.05, 1},
      {"mirror", "0 0 3 .5 .6 1.7", "reflectance", 1.7},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.type + " " + c.arguments);
    const auto excess = excessOf(materialOf({.type = c.type, .arguments = c.arguments}));
    ASSERT_TRUE(excess);
    EXPECT_EQ(excess->argument, c.argument);
    EXPECT_EQ(excess->value, c.value);
    EXPECT_NEAR(excess->most, c.most, .001);
  }
  for (const Row& row : rows()) EXPECT_FALSE(excessOf(materialOf(row))) << row.type;
  // A pane that transmits all light, and a rounded number.
  EXPECT_FALSE(excessOf(materialOf({.type = "glass", .arguments = "0 0 3 1.089 1.089 1.089"})));
  EXPECT_FALSE(excessOf(materialOf({.type = "plastic", .arguments = "0 0 5 1.0005 1 1 0 0"})));
}

TEST(MaterialQuestions, HaveTheseAnswers) {
  for (const Row& row : rows()) {
    const Material material = materialOf(row);
    SCOPED_TRACE(row.type + " " + row.arguments);
    EXPECT_EQ(isTransparent(material), row.transparent);
    EXPECT_EQ(stopsShadows(material).front, row.stops.front);
    EXPECT_EQ(stopsShadows(material).back, row.stops.back);
    EXPECT_EQ(isBoundary(material), row.boundary);
    EXPECT_EQ(enclosesVolume(material), row.encloses);
    const auto alternate = alternateOf(material);
    EXPECT_EQ(alternate.has_value(), row.alternate.has_value());
    if (alternate && row.alternate) {
      EXPECT_EQ(alternate->kind, *row.alternate);
    }
    EXPECT_EQ(isLightSource(material), row.source);
    if (row.sampled) {
      EXPECT_EQ(sourceRadiance(material)->color, Color(5, 6, 7));
    }
    EXPECT_EQ(isSampled(material), row.sampled);
    EXPECT_EQ(reachOf(material), row.reach);
    EXPECT_EQ(coverOf(material), row.cover);
    EXPECT_EQ(imagesMadeBy(material), row.images);
    const auto mirrors = mirrorReflection(material);
    ASSERT_EQ(mirrors.has_value(), row.mirrors.has_value());
    if (mirrors) {
      EXPECT_EQ(mirrors->share, row.mirrors->share);
      EXPECT_DOUBLE_EQ(mirrors->brightness, row.mirrors->brightness);
      EXPECT_EQ(mirrors->roughness, row.mirrors->roughness);
      EXPECT_EQ(mirrors->boundaries, row.mirrors->boundaries);
      EXPECT_EQ(mirrors->frontOnly, row.mirrors->frontOnly);
    }
    const auto diffuse = diffuseReflection(material);
    ASSERT_EQ(diffuse.has_value(), row.diffuse.has_value());
    if (diffuse) {
      EXPECT_EQ(diffuse->share, *row.diffuse);
      EXPECT_EQ(diffuse->color, Color(.5, .6, .7));
    }
  }
}

TEST(MaterialQuestions, AreTestedForEveryMaterialOfTheLanguage) {
  std::set<std::string_view> tested;
  std::set<size_t> alternatives;
  for (const Row& row : rows()) {
    tested.insert(row.type);
    alternatives.insert(materialOf(row).index());
  }
  for (int i = 0; i < rad::kTypes; ++i) {
    const auto type = static_cast<rad::Type>(i);
    if (rad::Type::light <= type && type <= rad::Type::antimatter) {
      EXPECT_TRUE(tested.contains(rad::typeName(type))) << rad::typeName(type);
    }
  }
  EXPECT_EQ(alternatives.size(), std::variant_size_v<Material>);
}

}  // namespace
}  // namespace rsphere
