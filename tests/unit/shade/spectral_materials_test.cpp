// Under a pattern with bands, each band of what a material makes of light is what it makes of it under a gray
// pattern of the band's value, in the band's channel.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "shade/material_response.h"
#include "tests/unit/shade/fake_hit.h"
#include "tests/unit/support/bsdf_xml.h"

namespace rsphere::spectral_materials_test {
namespace {

const SpectralSampling& sampling() { return spectralSampling(6, 380, 780); }

constexpr std::array<double, 6> kValues{.9, .25, .5, .7, .35, .6};
constexpr Color kColor{.8, .5, .3};

Color banded() {
  Bands bands(sampling());
  for (size_t i = 0; i < kValues.size(); ++i) bands.values()[i] = kValues[i];
  return Color(std::move(bands));
}

using Answers = std::vector<Color>;

// answers: what a material makes of a pattern. dependsOnPattern: of the numbers.
void expectBandsAlone(const std::function<Answers(const Color& pattern)>& answers) {
  const Answers all = answers(banded());
  ASSERT_FALSE(all.empty());
  bool anyBands = false;
  for (size_t i = 0; i < kValues.size(); ++i) {
    const int channel = sampling().channel[i];
    const Answers gray = answers(Color(kValues[i]));
    ASSERT_EQ(gray.size(), all.size()) << i;
    for (size_t k = 0; k < all.size(); ++k) {
      const double expected = gray[k][channel];
      EXPECT_NEAR(all[k].bandsIn(sampling()).values()[i], expected, 1e-13 * (1 + std::abs(expected)))
          << "answer " << k << ", band " << i;
      anyBands |= static_cast<bool>(all[k].bands());
    }
  }
  EXPECT_TRUE(anyBands);
}

Interaction at(double cosine, const Color& pattern) {
  Interaction i;
  i.cosine = cosine;
  i.direction = V3d(std::sqrt(1 - cosine * cosine), 0, -cosine);
  i.pattern = pattern;
  return i;
}

void add(Answers& all, const SharpPaths& paths) {
  for (const SharpPath& path : paths) {
    all.push_back(path.coefficient.color);
    all.push_back(path.medium.extinction);
    all.push_back(path.medium.albedo);
  }
}

// Everything that a model of scattering answers.
template <ScattersLight S>
Answers answersOf(S s) {
  Answers all;
  add(all, s.sharp());
  const V3d above = V3d(.5, .2, .9).normalized(), below = V3d(.6, -.1, -.7).normalized();
  for (const Component component : s.components()) {
    Random random(3);
    if (s.lobe(component, random)) all.push_back(s.draw(component, 0, 1, random).coefficient.color);
    all.push_back(s.indirect(component).color);
    if (!s.takesDirect(component)) continue;
    for (const V3d& source : {above, below})
      all.push_back(s.coefficient(component, source, .01, random).color);
  }
  return all;
}

class SpectralMaterials : public testing::TestWithParam<double> {
 protected:
  // -st: lobes are sampled, or are part of the indirect light.
  MaterialContext contextOf(double threshold) const {
    return {scene, functions, {.specularThreshold = threshold, .directJitter = .5}, {}};
  }
  double cosine() const { return GetParam(); }

  template <class M>
  void expectRound(const M& material) {
    for (const double threshold : {0., 1.}) {
      MaterialContext context = contextOf(threshold);
      expectBandsAlone([&](const Color& pattern) {
        return answersOf(RoundScattering(material, FakeHit(at(cosine(), pattern), context)));
      });
    }
  }

  Scene scene;
  SurfaceFunctions functions{scene, nullptr};
};
INSTANTIATE_TEST_SUITE_P(Angles, SpectralMaterials, testing::Values(.95, .1));

TEST_P(SpectralMaterials, Plastic) {
  expectRound(Opaque{kColor, .05, 0});
  expectRound(Opaque{kColor, .05, .1});
}

TEST_P(SpectralMaterials, Metal) {
  expectRound(Opaque{kColor, .8, 0, true});  // with Fresnel's rise to white
  expectRound(Opaque{kColor, .8, .1, true});
}

TEST_P(SpectralMaterials, Trans) {
  expectRound(Trans{kColor, .05, 0, .5, .6});
  expectRound(Trans{kColor, .05, .1, .5, .6});
}

TEST_P(SpectralMaterials, Elliptic) {
  for (const Anisotropic& m : {Anisotropic{kColor, .2, .1, .3, false}, Anisotropic{kColor, .2, .1, .3, true},
                               Anisotropic{kColor, .2, .1, .3, false, true, .5, .6}})
    for (const double threshold : {0., 1.}) {
      MaterialContext context = contextOf(threshold);
      expectBandsAlone([&](const Color& pattern) {
        return answersOf(EllipticScattering(m, V3d(1, 1, 0), FakeHit(at(cosine(), pattern), context)));
      });
    }
}

TEST_P(SpectralMaterials, Ashik2) {
  for (const double threshold : {0., 1.})
    expectBandsAlone([&](const Color& pattern) {
      const Interaction i = at(cosine(), pattern);
      return answersOf(AshikhminLobeScattering(
          scatter(Ashikhmin{kColor, Color(.2, .3, .4), 20, 60}, i, V3d(1, 1, 0), threshold), i));
    });
}

TEST_P(SpectralMaterials, FunctionsOfTheDirection) {
  for (const bool metal : {false, true})
    expectBandsAlone([&](const Color& pattern) {
      const FunctionScatterer m{kColor, .3, metal, .4, .5};
      const FunctionScattering s = scatter(m, at(cosine(), pattern));
      Answers all{s.color, s.ambientReflection, s.ambientTransmission};
      for (const V3d& source : {V3d(.6, 0, .8), V3d(.6, 0, -.8)})
        all.push_back(directCoefficient(s, source, .01, [] { return Color(.3, .2, .1); }).color);
      return all;
    });
}

TEST_P(SpectralMaterials, BrtdFunction) {
  expectBandsAlone([&](const Color& pattern) {
    const BrtdFunction m{kColor, Color(.2, .3, .4), Color(.1, .2, .3)};
    const Interaction i = at(cosine(), pattern);
    const FunctionScattering s = scatter(m, i);
    Answers all{s.ambientReflection, s.ambientTransmission};
    add(all, SharpPaths{{sharpReflection(s, i, {.1, .2, .3}), sharpTransmission(s, i, {.3, .2, .1})}, 2});
    for (const V3d& source : {V3d(.6, 0, .8), V3d(.6, 0, -.8)})
      all.push_back(directCoefficient(s, source, .01, [] { return Color(.3, .2, .1); }).color);
    return all;
  });
}

TEST_P(SpectralMaterials, WgmdFunction) {
  WgmdFunction m;
  m.diffuseFront = kColor;
  m.diffuseTransmitted = Color(.1, .2, .3);
  for (const double roughness : {0., .2})
    for (const double threshold : {0., 1.})
      expectBandsAlone([&](const Color& pattern) {
        const Interaction i = at(cosine(), pattern);
        const WgmdComponent reflected{i, .3, roughness, roughness}, through{i, .4, roughness, roughness};
        return answersOf(EllipticScattering(scatter(m, reflected, through, i, i, V3d(1, 1, 0), threshold), i,
                                            MaterialOptions{.specularThreshold = threshold}));
      });
}

BsdfData dataOf(const std::string& xml) {
  return BsdfData(rad::BsdfFile::parse(xml, "a.xml", [](std::string_view) {}), "a.xml", {});
}

TEST_P(SpectralMaterials, Bsdf) {
  const BsdfData data = dataOf(quarterXml());
  for (const double threshold : {0., 1.})
    expectBandsAlone([&](const Color& pattern) {
      BsdfMaterial m;
      m.diffuseFront = kColor;
      const Interaction i = at(cosine(), pattern);
      return answersOf(BsdfScattering(m, data, i, *bsdfFrame(i, V3d(0, 1, 0)), 0, 4,
                                      MaterialOptions{.specularThreshold = threshold}));
    });
}

// Where the lobe is not sampled, what is left of it beside the peak is estimated by brightness, as in
// RADIANCE.
TEST_P(SpectralMaterials, BsdfOfAPane) {
  const BsdfData data = dataOf(tree4Xml());
  expectBandsAlone([&](const Color& pattern) {
    BsdfMaterial m;
    m.aperture = true;
    m.diffuseTransmitted = kColor;
    const Interaction i = at(cosine(), pattern);
    return answersOf(BsdfScattering(m, data, i, *bsdfFrame(i, V3d(0, 1, 0)), 0, 4,
                                    MaterialOptions{.specularThreshold = 0}));
  });
}

TEST_P(SpectralMaterials, Boundaries) {
  for (const bool front : {true, false})
    expectBandsAlone([&](const Color& pattern) {
      Interaction i = at(cosine(), pattern);
      i.front = front;
      Answers all;
      for (const Scattering& s : {scatter(Dielectric{kColor, 1.5}, i, Medium{}),
                                  scatter(Interface{kColor, 1.5, Color(.9, .8, .7), 1.3}, i)}) {
        add(all, s.sharp);
        all.push_back(s.medium.extinction);
      }
      return all;
    });
}

TEST_P(SpectralMaterials, GlassAndMirror) {
  expectBandsAlone([&](const Color& pattern) {
    const Interaction i = at(cosine(), pattern);
    Answers all;
    add(all, scatter(Glass{kColor}, i).sharp);
    add(all, scatter(Mirror{kColor, {}}, i).sharp);
    return all;
  });
}

// ---- what response() alone multiplies by the pattern

template <class Outcome, class M>
Outcome outcomeOf(const M& material, const Color& pattern, const Arrival& arrival = {}) {
  const Scene scene;
  const SurfaceFunctions functions(scene, nullptr);
  MaterialContext context{scene, functions, {}, {}};
  Interaction i;
  i.pattern = pattern;
  i.kinds = arrival.kinds;
  FakeHit hit(i, context);
  if constexpr (std::is_same_v<Outcome, CrossesMist>)
    return response(material, hit);
  else
    return std::get<Outcome>(response(material, hit));
}

TEST(SpectralEmission, HasThePattern) {
  for (const auto& make : std::vector<std::function<Answers(const Color&)>>{
           [](const Color& p) { return Answers{outcomeOf<Emits>(Light{kColor}, p).radiance.color}; },
           [](const Color& p) {
             return Answers{outcomeOf<Emits>(Glow{kColor, 0}, p).radiance.color};
           },
           [](const Color& p) {
             return Answers{outcomeOf<Emits>(Spotlight{kColor, 1, V3d(0, 0, 1), 1}, p).radiance.color};
           }})
    expectBandsAlone(make);
}

TEST(SpectralMist, HasThePattern) {
  Mist mist;
  mist.extinction = kColor;
  expectBandsAlone([&](const Color& p) { return Answers{outcomeOf<CrossesMist>(mist, p).extinction}; });
}

}  // namespace
}  // namespace rsphere::spectral_materials_test
