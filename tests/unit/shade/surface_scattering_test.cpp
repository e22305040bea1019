#include "shade/surface_scattering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/constants.h"
#include "shade/bsdf_scattering.h"
#include "tests/unit/shade/fake_hit.h"
#include "tests/unit/shade/lobe_sampling.h"
#include "tests/unit/support/bsdf_xml.h"

namespace rsphere::surface_scattering_test {
namespace {

constexpr double kTiny = 1e-9;    // sr, of a source for which a lobe is a number
constexpr double kThreshold = 0;  // -st: all lobes are sampled
const MaterialOptions kOptions{.specularThreshold = kThreshold, .directJitter = 1};
const V3d kAlong(.9, .4, .2);

template <class M>
RoundScattering roundScattering(const M& material, const Interaction& at) {
  const Scene scene;
  const SurfaceFunctions functions(scene, nullptr);
  MaterialContext context{scene, functions, kOptions};
  return RoundScattering(material, FakeHit(at, context));
}

Color gray(double x) { return Color(x, x, x); }

// Radiance that depends on the direction in all ways, between 0 and 2.
double sky(const V3d& d) { return 1 + .5 * d.x + .3 * d.y - .2 * d.z; }

// The light of the sky by samples of one lobe.
template <ScattersLight S>
Sample bySamples(S s, Component component, uint64_t seed, int n = 1) {
  Random random(seed);
  Sample sample;
  if (!s.lobe(component, random)) return sample;
  for (int k = 0; k < 40000 / n; ++k) {
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const LobeSample drawn = s.draw(component, i, n, random);
      if (!isBlack(drawn.coefficient)) sum += drawn.coefficient.color.x * sky(drawn.direction);
    }
    sample.add(sum);
  }
  return sample;
}

// The light of the same sky by its coefficients as direct light, as a sum over a grid of directions about the
// middle of the lobe, up to half the chord `widest` from it.
template <ScattersLight S>
double byDirectLight(const S& s, Component component, const V3d& middle, double widest) {
  constexpr int kRows = 200, kColumns = 200;
  Random random(5);
  const auto [x, y] = frame(middle);
  double sum = 0;
  for (int row = 0; row < kRows; ++row) {
    const double c = widest * (row + .5) / kRows;
    const double cosine = 1 - 2 * c * c, sine = std::sqrt(std::max(0., 1 - cosine * cosine));
    const double omega = 4 * c * widest / kRows * 2 * kPi / kColumns;
    for (int k = 0; k < kColumns; ++k) {
      const double angle = (k + .5) / kColumns * 2 * kPi;
      const V3d d = cosine * middle + sine * (std::cos(angle) * x + std::sin(angle) * y);
      sum += s.coefficient(component, d, kTiny, random).color.x / kTiny * omega * sky(d);
    }
  }
  return sum;
}

// That samples and direct light agree, and that 5% more or another surface would be noticed. bias: relative,
// of the samples against direct light, where a model has one.
void expectEqual(const Sample& sample, double direct, double bias) {
  const double error = kMostSigmas * sample.standardError() + bias * direct;
  EXPECT_NEAR(sample.mean(), direct, error);
  EXPECT_GT(std::abs(sample.mean() - 1.05 * direct), error);
}

template <ScattersLight S>
void expectAgreement(std::string_view name, const S& s, const S& spoiled, Component component,
                     const V3d& middle, double widest, double bias = 0) {
  SCOPED_TRACE(name);
  const double direct = byDirectLight(s, component, middle, widest);
  for (const int n : {1, 4}) expectEqual(bySamples(s, component, 11 + n, n), direct, bias);
  const Sample sample = bySamples(s, component, 21);
  EXPECT_GT(std::abs(sample.mean() - byDirectLight(spoiled, component, middle, widest)),
            kMostSigmas * sample.standardError() + bias * direct);
}

constexpr double kHemisphere = .70710678;  // half the chord over 90 degrees

TEST(SurfaceScattering, SamplesSeeWhatDirectLightSees) {
  const Interaction at = arriving(.8), vertical = arriving(1);
  const V3d up(0, 0, 1), down(0, 0, -1);
  const auto shiny = [&](double specularity, double roughness) {
    return roundScattering(Opaque{gray(0), specularity, roughness, false}, at);
  };
  expectAgreement("plastic", shiny(.5, .2), shiny(.53, .2), Component::reflected, up, kHemisphere);

  // The transmitted lobes of samples and of direct light agree for light that comes at right angles, but for
  // the order of the squared roughness.
  const auto clear = [&](double transmissivity) {
    return roundScattering(Trans{gray(1), 0, .02, transmissivity, 1}, vertical);
  };
  expectAgreement("trans", clear(.5), clear(.53), Component::transmitted, down, .1, .0004);

  const auto brushed = [&](double specularity) {
    Anisotropic m;
    m.color = gray(0);
    m.specularity = specularity;
    m.roughnessAlong = .3;
    m.roughnessAcross = .12;
    return EllipticScattering(scatter(m, at, kAlong, kThreshold), at, kOptions);
  };
  expectAgreement("plastic2", brushed(.5), brushed(.53), Component::reflected, up, kHemisphere);

  // Its samples all have weight 1, which is right only in the limit of a smooth surface.
  const auto ashik = [&](double specular) {
    return AshikhminLobeScattering(
        scatter(Ashikhmin{gray(0), gray(specular), 20000, 60000, kNone}, vertical, kAlong, kThreshold),
        vertical);
  };
  expectAgreement("ashik2", ashik(.5), ashik(.53), Component::reflected, up, .05);
}

BsdfScattering bsdf(const BsdfData& data, const Interaction& at, const MaterialOptions& options,
                    double thickness = 0) {
  return {BsdfMaterial{}, data, at, *bsdfFrame(at, V3d(0, 1, 0)), thickness, 4, options};
}

BsdfData halfData() {
  return BsdfData(rad::BsdfFile::parse(halfXml(), "a.xml", [](std::string_view) {}), "a.xml", {});
}

TEST(BsdfScattering, SamplesSeeWhatDirectLightSees) {
  const BsdfData data = halfData();
  const Interaction at = arriving(.8);
  for (const Component c : {Component::reflected, Component::transmitted}) {
    BsdfScattering s = bsdf(data, at, kOptions);
    const V3d middle = c == Component::reflected ? at.normal : -at.normal;
    // Direct light has the diffuse part too.
    const Color indirect = s.indirect(c).color;
    double diffuse = 0;
    constexpr int kCells = 400;
    for (int i = 0; i < kCells; ++i) {  // the cosine-weighted mean of the sky over the hemisphere
      const double cosine = std::sqrt((i + .5) / kCells);
      diffuse += indirect.x * sky(cosine * middle) / kCells;
    }
    const double direct = byDirectLight(s, Component::reflected, middle, kHemisphere) - diffuse;
    ASSERT_GT(direct, 0);
    // The view is shifted by the size of the finest cell for samples, of the actual cell for direct light.
    constexpr double kShift = .01;
    expectEqual(bySamples(s, c, 31), direct, kShift);
    expectEqual(bySamples(s, c, 32, 4), direct, kShift);
  }
}

// -st: what is not sampled adds to the indirect light instead.
TEST(BsdfScattering, WeakLobesAreIndirectLight) {
  const BsdfData data = halfData();
  MaterialOptions options = kOptions;
  options.specularThreshold = 1;
  BsdfScattering s = bsdf(data, arriving(.8), options);
  const double before = s.indirect(Component::transmitted).color.x;
  Random random(1);
  EXPECT_FALSE(s.lobe(Component::transmitted, random));
  const double after = s.indirect(Component::transmitted).color.x;
  BsdfScattering sampled = bsdf(data, arriving(.8), kOptions);
  Random same(1);
  const std::optional<Lobe> lobe = sampled.lobe(Component::transmitted, same);
  ASSERT_TRUE(lobe);
  EXPECT_DOUBLE_EQ(after, before + lobe->share);
  EXPECT_EQ(sampled.indirect(Component::transmitted).color.x, before);
}

// Light is transmitted behind the thickness; without one, all direct light arrives at the same point.
TEST(BsdfScattering, ThicknessPartsTheTwoSides) {
  const BsdfData data = halfData();
  const V3d above(0, .6, .8), below(0, .6, -.8);
  Random random(2);
  BsdfScattering thin = bsdf(data, arriving(.8), kOptions), thick = bsdf(data, arriving(.8), kOptions, .25);
  EXPECT_TRUE(thin.takesDirect(Component::reflected));
  EXPECT_FALSE(thin.takesDirect(Component::transmitted));
  EXPECT_GT(thin.coefficient(Component::reflected, below, .1, random).color.x, 0);
  EXPECT_TRUE(thick.takesDirect(Component::transmitted));
  EXPECT_EQ(thick.offset(Component::transmitted), V3d(0, 0, -.25));
  EXPECT_EQ(thick.coefficient(Component::reflected, below, .1, random).color.x, 0);
  EXPECT_EQ(thick.coefficient(Component::transmitted, above, .1, random).color.x, 0);
  EXPECT_GT(thick.coefficient(Component::reflected, above, .1, random).color.x, 0);
  EXPECT_GT(thick.coefficient(Component::transmitted, below, .1, random).color.x, 0);
}

// The first numbers of a lobe's samples are stratified: their mean is nearer to the truth.
TEST(SurfaceScattering, SamplesOfALobeAreStratified) {
  const RoundScattering s = roundScattering(Opaque{gray(0), .5, .2, false}, arriving(.8));
  const Sample single = bySamples(s, Component::reflected, 41),
               four = bySamples(s, Component::reflected, 42, 4);
  EXPECT_LT(four.standardError(), .95 * single.standardError());  // of as many samples
}

TEST(SurfaceScattering, NoOffsetKeepsSigns) {
  for (const double x : {0., -0., 1., -2.}) {
    const V3d moved = V3d(x, x, x) + kNoOffset;
    EXPECT_EQ(moved, V3d(x, x, x));
    EXPECT_EQ(std::signbit(moved.x), std::signbit(x));
  }
}

TEST(SurfaceScattering, TellsWhereDirectLightMatters) {
  const Interaction at = arriving(.8);
  const RoundScattering black = roundScattering(Opaque{gray(0), 0, 0, false}, at);
  EXPECT_FALSE(black.takesDirect(Component::reflected));
  const RoundScattering matt = roundScattering(Opaque{gray(.5), 0, 0, false}, at);
  EXPECT_EQ(matt.components().size(), 1u);
  EXPECT_TRUE(matt.takesDirect(Component::reflected));
  EXPECT_TRUE(matt.isEven());
  EXPECT_EQ(matt.front(), at.normal);
  EXPECT_EQ(matt.indirect(Component::reflected).color, gray(.5));
  const RoundScattering glossy = roundScattering(Opaque{gray(.5), .1, .05, false}, at);
  EXPECT_FALSE(glossy.isEven());
  const RoundScattering paper = roundScattering(Trans{gray(.5), 0, 0, .5, 0}, at);
  EXPECT_FALSE(paper.takesDirect(Component::reflected)) << "that of both sides comes last";
  EXPECT_TRUE(paper.takesDirect(Component::transmitted));
  EXPECT_EQ(paper.front(), V3d(0, 0, 0));
  EXPECT_EQ(paper.normal(Component::transmitted), at.normal);
}

}  // namespace
}  // namespace rsphere::surface_scattering_test
