#include "shade/material_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "tests/unit/shade/fake_hit.h"

namespace rsphere {
namespace {

class Response : public testing::Test {
 protected:
  template <class M>
  auto of(const M& material, const Arrival& arrival) {
    FakeHit hit(arrival, context);
    auto answer = response(material, hit);
    turned = hit.turned;
    return answer;
  }

  Scene scene;
  SurfaceFunctions functions{scene, nullptr};
  MaterialContext context{scene, functions, {}};
  MaterialOptions& options = context.options;
  bool turned = false;

  const Arrival front{.surface = SurfaceId(3)}, back{.cosine = -1, .surface = SurfaceId(3)};
  const Arrival shadow{.kinds = kPrimary | kReflectedShadow, .surface = SurfaceId(3), .target = SurfaceId(7)};
};

template <class Outcome, class Variant>
bool is(const Variant& answer) {
  return std::holds_alternative<Outcome>(answer);
}

constexpr Color kGray{.5, .5, .5};

TEST_F(Response, OpaqueBlocksShadowRaysAndTransFollowsThem) {
  EXPECT_TRUE(is<Absorbs>(of(Opaque{kGray}, shadow)));
  EXPECT_TRUE(is<RoundScattering>(of(Trans{kGray, 0, 0, .5, 1}, shadow)));
  EXPECT_TRUE(is<RoundScattering>(of(Opaque{kGray}, front)));
}

TEST_F(Response, BacksAreTurnedRoundOrInvisible) {
  EXPECT_TRUE(is<RoundScattering>(of(Opaque{kGray}, back)));
  EXPECT_TRUE(turned);
  EXPECT_TRUE(is<ReflectsSharply>(of(Glass{Color(.9, .9, .9)}, back)));
  EXPECT_TRUE(turned);
  EXPECT_TRUE(is<Absorbs>(of(Light{kGray}, back)));
  of(Dielectric{kGray, 1.5}, back);
  EXPECT_FALSE(turned) << "a boundary has two different sides";
  options.backFacesVisible = false;
  EXPECT_TRUE(is<Passes>(of(Opaque{kGray}, back)));
  EXPECT_TRUE(is<Passes>(of(Glass{Color(.9, .9, .9)}, back)));
  EXPECT_TRUE(is<Passes>(of(Light{kGray}, back)));
  EXPECT_TRUE(is<RoundScattering>(of(Opaque{kGray}, front)));
}

TEST_F(Response, BoundariesKnowTheMediumThatTheRayCameThrough) {
  const Dielectric water{Color(.5, .5, .5), 1.33};
  EXPECT_EQ(of(water, front).scattering.medium.extinction, Color(.1, .1, .1)) << "the ray's";
  EXPECT_NEAR(of(water, back).scattering.medium.extinction.x, -std::log(.25), 1e-12)
      << "the pattern absorbs too";
}

TEST_F(Response, EmissionIsCountedOnce) {
  const auto emitted = of(Light{Color(4, 4, 4)}, front);
  ASSERT_TRUE(is<Emits>(emitted));
  EXPECT_EQ(std::get<Emits>(emitted).radiance.color, Color(2, 2, 2)) << "with its pattern";
  Arrival indirect = front;
  indirect.kinds |= kReflectedAmbient;
  EXPECT_TRUE(is<Absorbs>(of(Light{kGray}, indirect))) << "next-event estimation includes it";
  indirect.length = 5;
  EXPECT_TRUE(is<Absorbs>(of(Glow{kGray, 6}, indirect)));
  EXPECT_TRUE(is<Emits>(of(Glow{kGray, 4}, indirect))) << "beyond its reach it is not sampled";
  EXPECT_TRUE(is<Absorbs>(of(Glow{kGray, -1}, indirect))) << "it does not light the scene";
}

TEST_F(Response, ShadowRaysSeeTheirOwnSourceOnly) {
  EXPECT_TRUE(is<Absorbs>(of(Light{kGray}, shadow)));
  Arrival aimed = shadow;
  aimed.target = aimed.surface;
  EXPECT_TRUE(is<Emits>(of(Light{kGray}, aimed)));
  aimed.atImage = true;
  EXPECT_TRUE(is<Absorbs>(of(Light{kGray}, aimed)));
}

TEST_F(Response, InvisibleSourcesStillLight) {
  options.sourcesVisible = false;
  EXPECT_TRUE(is<Absorbs>(of(Light{kGray}, front)));
  Arrival aimed = shadow;
  aimed.target = aimed.surface;
  EXPECT_TRUE(is<Emits>(of(Light{kGray}, aimed)));
}

TEST_F(Response, SpotlightsShineInTheirCone) {
  Spotlight spot{kGray, .1, V3d(0, 0, 1), 1};
  EXPECT_TRUE(is<Emits>(of(spot, front)));
  spot.aim = V3d(1, 0, 0);
  EXPECT_TRUE(is<Absorbs>(of(spot, front)));
}

TEST_F(Response, MirrorsRelayRaysThatAreAimedAtTheirImages) {
  const Mirror mirror{Color(.8, .8, .8), {}};
  EXPECT_TRUE(is<ReflectsSharply>(of(mirror, front)));
  EXPECT_TRUE(is<Absorbs>(of(mirror, shadow))) << "aimed at another source";
  Arrival aimed = shadow;
  aimed.target = aimed.surface;
  aimed.atImage = true;
  const auto answer = of(mirror, aimed);
  ASSERT_TRUE(is<Relays>(answer));
  EXPECT_EQ(std::get<Relays>(answer).path.direction, V3d(0, 0, 1));
  EXPECT_NEAR(std::get<Relays>(answer).path.coefficient.color.x, .4, 1e-12) << "with the pattern";
  EXPECT_TRUE(is<Absorbs>(of(mirror, back)));
}

TEST_F(Response, IllumsEmitAsSourcesAndAreOtherwiseTheirAlternate) {
  const Illum illum{kGray, {}};
  EXPECT_TRUE(is<Alternate>(of(illum, front)));
  Arrival aimed = shadow;
  aimed.target = aimed.surface;
  EXPECT_TRUE(is<Emits>(of(illum, aimed)));
}

TEST_F(Response, VolumesSayWhetherTheyAreEntered) {
  Mist mist;
  mist.extinction = Color(.4, .4, .4);
  const CrossesMist in = of(mist, front);
  EXPECT_TRUE(in.enters);
  EXPECT_NEAR(in.extinction.x, .2, 1e-12) << "with the pattern";
  EXPECT_FALSE(of(mist, back).enters);
  EXPECT_TRUE(of(Antimatter{5}, front).enters);
  EXPECT_EQ(of(Antimatter{5}, back).clips, 5u);
}

TEST_F(Response, GoalsEmitImportanceOnce) {
  Arrival indirect = front;
  indirect.kinds |= kReflectedAmbient;
  FakeHit seen(front, context), met(indirect, context);
  EXPECT_TRUE(is<Emits>(goalResponse(Radiance(1), true, seen)));
  EXPECT_TRUE(is<Absorbs>(goalResponse(Radiance(1), true, met)));
  EXPECT_TRUE(is<Emits>(goalResponse(Radiance(1), false, met)));
}

}  // namespace
}  // namespace rsphere
