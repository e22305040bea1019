#include "shade/scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/constants.h"
#include "tests/unit/shade/lobe_sampling.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

constexpr double kSampleAll = 0;  // -st

const SharpPath* find(const Scattering& s, RayKind kind) {
  for (const SharpPath& p : s.sharp)
    if (p.kind == kind) return &p;
  return nullptr;
}

double coefficient(const Scattering& s, RayKind kind) {
  const SharpPath* p = find(s, kind);
  return p ? p->coefficient.color.x : 0;
}

// ---- energy

// The mean weight of a lobe's samples is the share of light that it sends on.
template <class SampleLobe>
Sample meanWeight(const Scattering& s, const Interaction& at, Random& random, SampleLobe sampleLobe) {
  Sample weights;
  V3d direction;
  for (int i = 0; i < 400; ++i)
    weights.add(sampleLobe(s, at, 1, random.uniform(), random.uniform(), direction));
  return weights;
}

// All that leaves along the ray under unit radiance from everywhere; the excess over 1 is what the sampling
// error allows.
void expectNoGain(const Scattering& s, const Interaction& at, Random& random) {
  for (int channel = 0; channel < 3; ++channel) {
    double sum = s.diffuseReflection[channel] + s.diffuseTransmission[channel], variance = 0;
    for (const SharpPath& p : s.sharp) sum += p.coefficient.color[channel];
    const auto addLobe = [&](const Color& share, auto sampleLobe) {
      EXPECT_GE(share[channel], 0);
      if (share[channel] == 0) return;
      const Sample w = meanWeight(s, at, random, sampleLobe);
      sum += share[channel] * w.mean();
      variance += std::pow(share[channel] * w.standardError(), 2);
    };
    addLobe(s.specularReflection, sampleReflection);
    addLobe(s.specularTransmission, sampleTransmission);
    EXPECT_LE(sum, 1 + 1e-9 + kMostSigmas * std::sqrt(variance)) << "channel " << channel;
    EXPECT_GE(s.diffuseReflection[channel], -1e-12);
    EXPECT_GE(s.diffuseTransmission[channel], -1e-12);
  }
}

TEST(Energy, NoMaterialGainsLight) {
  Random random(21);
  for (int i = 0; i < 1000; ++i) {
    const auto share = [&] { return random.uniform(); };
    Interaction at = arriving(between(random, .02, 1));
    at.flat = i % 2;
    const double roughness = i % 3 ? between(random, .01, .4) : 0;
    const Color color(share(), share(), share());
    SCOPED_TRACE(testing::Message() << "material " << i << ", cosine " << at.cosine);
    expectNoGain(scatter(Opaque{color, share(), roughness, false}, at, kSampleAll), at, random);
    expectNoGain(scatter(Opaque{color, share(), roughness, true}, at, kSampleAll), at, random);
    expectNoGain(scatter(Trans{color, share(), roughness, share(), share()}, at, kSampleAll), at, random);
    expectNoGain(scatter(Glass{color, between(random, 1, 3)}, at), at, random);
    expectNoGain(scatter(Mirror{color, {}}, at), at, random);
  }
}

// Radiance is squeezed by n^2 when it enters the denser medium: without that, what is reflected and what is
// refracted make up the whole.
TEST(Energy, BoundariesSplitLightWithoutLoss) {
  Random random(22);
  for (int i = 0; i < 1000; ++i) {
    Interaction at = arriving(between(random, .01, 1));
    at.front = i % 2;
    const double inner = between(random, 1, 2.5), outer = between(random, 1, 2.5);
    const Scattering s = scatter(Interface{Color(1, 1, 1), inner, Color(1, 1, 1), outer}, at);
    const double ratio = at.front ? outer / inner : inner / outer;
    EXPECT_NEAR(coefficient(s, kReflected) + coefficient(s, kRefracted) / (ratio * ratio), 1, 1e-12);
  }
}

// ---- Fresnel, Snell, panes

TEST(Dielectric, ReflectsAsTextbooksSay) {
  const Dielectric water{Color(1, 1, 1), 1.33, 0}, crown{Color(1, 1, 1), 1.5, 0};
  const Medium air;
  // At right angles ((n-1)/(n+1))^2: 4% for glass, 2% for water.
  EXPECT_NEAR(coefficient(scatter(crown, arriving(1), air), kReflected), .04, 1e-12);
  EXPECT_NEAR(coefficient(scatter(water, arriving(1), air), kReflected), std::pow(.33 / 2.33, 2), 1e-12);
  // Glass at 60 degrees: rs = .4202, rp = -.0424, so 8.92%.
  EXPECT_NEAR(coefficient(scatter(crown, arriving(.5), air), kReflected), .0892, 5e-5);
  // At Brewster's angle nothing is reflected of one polarisation: half of ((n^2-1)/(n^2+1))^2.
  EXPECT_NEAR(coefficient(scatter(crown, arriving(std::cos(std::atan(1.5))), air), kReflected),
              std::pow(1.25 / 3.25, 2) / 2, 1e-12);
}

TEST(Dielectric, RefractsAsSnellSays) {
  Random random(23);
  for (int i = 0; i < 200; ++i) {
    Interaction at = arriving(between(random, .05, 1));
    at.front = i % 2;
    const double n = 1.5, ratio = at.front ? 1 / n : n;
    const Scattering s = scatter(Dielectric{Color(1, 1, 1), n, 0}, at, {});
    const double sine = ratio * std::sqrt(1 - at.cosine * at.cosine);
    const SharpPath* refracted = find(s, kRefracted);
    if (sine >= 1) {
      EXPECT_EQ(refracted, nullptr) << "total reflection";
      EXPECT_NEAR(coefficient(s, kReflected), 1, 1e-12);
    } else {
      ASSERT_NE(refracted, nullptr);
      EXPECT_NEAR(refracted->direction.x, sine, 1e-12);
      EXPECT_NEAR(refracted->direction.y, 0, 1e-15);
      EXPECT_LT(refracted->direction.z, 0);
    }
    const SharpPath* reflected = find(s, kReflected);
    ASSERT_NE(reflected, nullptr);
    EXPECT_NEAR((reflected->direction - V3d(at.direction.x, 0, at.cosine)).length(), 0, 1e-14);
  }
}

TEST(Dielectric, TellsTheMediumOnBothSides) {
  const Dielectric tinted{Color(.5, 1, .25), 1.5, 0};
  const Color haze(.1, .2, .3);
  Interaction at = arriving(.8);
  const Scattering in = scatter(tinted, at, {haze});
  EXPECT_EQ(in.medium.extinction, haze);
  EXPECT_TRUE(find(in, kRefracted)->entersMedium);
  EXPECT_NEAR(find(in, kRefracted)->medium.extinction.x, std::log(2.), 1e-15);
  EXPECT_EQ(find(in, kRefracted)->medium.extinction.y, 0);
  EXPECT_EQ(find(in, kReflected)->medium.extinction, haze);
  at.front = false;
  const Scattering out = scatter(tinted, at, {haze});
  EXPECT_NEAR(out.medium.extinction.z, std::log(4.), 1e-15);
  EXPECT_EQ(find(out, kRefracted)->medium.extinction, haze);
}

TEST(Dielectric, HartmannsConstantRaisesTheIndex) {
  const Scattering s = scatter(Dielectric{Color(1, 1, 1), 1.48, 10}, arriving(1), {});
  EXPECT_NEAR(coefficient(s, kReflected), .04, 1e-12) << "1.48 + 10/500";
}

TEST(Interface, OfEqualIndicesIsNotSeen) {
  const Scattering s = scatter(Interface{Color(1, 1, 1), 1.5, Color(1, 1, 1), 1.5}, arriving(.3));
  EXPECT_NEAR(coefficient(s, kReflected), 0, 1e-12);
  EXPECT_NEAR(coefficient(s, kRefracted), 1, 1e-12);
  EXPECT_NEAR((find(s, kRefracted)->direction - arriving(.3).direction).length(), 0, 1e-12);
}

// A pane as an endless series of passes between its faces, summed one by one, for each polarisation.
TEST(Glass, SumsAllReflectionsWithinThePane) {
  Random random(24);
  for (int i = 0; i < 200; ++i) {
    const double n = between(random, 1.1, 2.5), tn = between(random, .1, 1), cosine = between(random, .05, 1);
    const double beyond = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double t = std::pow(tn, 1 / beyond);
    double transmitted = 0, reflected = 0;
    for (const double amplitude :
         {(cosine - n * beyond) / (cosine + n * beyond), (n * cosine - beyond) / (n * cosine + beyond)}) {
      const double r = amplitude * amplitude;
      double inside = (1 - r) / 2;
      reflected += r / 2;
      for (int pass = 0; pass < 400; ++pass) {
        inside *= t;
        (pass % 2 ? reflected : transmitted) += inside * (1 - r);
        inside *= r;
      }
    }
    const Scattering s = scatter(Glass{Color(tn, tn, tn), n}, arriving(cosine));
    EXPECT_NEAR(coefficient(s, kTransmitted), transmitted, 1e-12);
    EXPECT_NEAR(coefficient(s, kReflected), reflected, 1e-12);
  }
}

// The manual's figure: a pane of 88% transmittance has a transmissivity of .96.
TEST(Glass, OfTransmissivity96Transmits88Percent) {
  const Scattering s = scatter(Glass{Color(.96, .96, .96), 1.52}, arriving(1));
  EXPECT_NEAR(coefficient(s, kTransmitted), .88, 2e-3);
  EXPECT_EQ(find(s, kTransmitted)->direction, V3d(0, 0, -1));
}

TEST(Mirror, ReflectsItsColorAtEqualAngles) {
  Interaction at = arriving(.6);
  at.pattern = Color(.5, 1, 1);
  const Scattering s = scatter(Mirror{Color(.8, .7, .6), {}}, at);
  ASSERT_EQ(s.sharp.count, 1u);
  EXPECT_NEAR((find(s, kReflected)->direction - V3d(.8, 0, .6)).length(), 0, 1e-15);
  EXPECT_EQ(find(s, kReflected)->coefficient.color, Color(.4, .7, .6));
}

// ---- plastic, metal, trans

TEST(Plastic, PolishedRisesToAFullReflectionAtGrazingAngles) {
  const Opaque polished{Color(.5, .5, .5), .05, 0, false};
  EXPECT_NEAR(coefficient(scatter(polished, arriving(1), kSampleAll), kReflected), .05, 1e-11);
  EXPECT_GT(coefficient(scatter(polished, arriving(.001), kSampleAll), kReflected), .98);
  double last = 0;
  for (double cosine = 1; cosine > .01; cosine -= .01) {
    const Scattering s = scatter(polished, arriving(cosine), kSampleAll);
    EXPECT_GE(coefficient(s, kReflected), last);
    last = coefficient(s, kReflected);
    EXPECT_NEAR(s.diffuseReflection.x, .5 * (1 - last), 1e-12);
    EXPECT_EQ(s.specularReflection, Color(0, 0, 0));
  }
}

// Ward's exponential stands for Fresnel's equations of an index of 1.5.
TEST(Plastic, PolishedFollowsFresnelWithinHalfAPercent) {
  const double clear = .04;
  for (double cosine = .1; cosine <= 1; cosine += .05) {
    const double approximate = coefficient(
        scatter(Opaque{Color(0, 0, 0), clear, 0, false}, arriving(cosine), kSampleAll), kReflected);
    const double exact =
        coefficient(scatter(Dielectric{Color(1, 1, 1), 1.5, 0}, arriving(cosine), {}), kReflected);
    EXPECT_NEAR(approximate, exact, .005);
  }
}

TEST(Metal, ColorsItsHighlightsAndPlasticDoesNot) {
  const Color red(.8, .2, .1);
  for (const double roughness : {0., .1}) {
    const auto highlight = [&](bool metal) {
      const Scattering s = scatter(Opaque{red, .9, roughness, metal}, arriving(1), kSampleAll);
      return roughness > 0 ? s.specularReflection : find(s, kReflected)->coefficient.color;
    };
    EXPECT_NEAR(highlight(true).x, .72, 1e-12);
    EXPECT_NEAR(highlight(true).z, .09, 1e-12);
    EXPECT_NEAR(highlight(false).x, .9, 1e-12);
    EXPECT_NEAR(highlight(false).z, .9, 1e-12);
  }
}

// Shares as the manual's equations for trans give them.
TEST(Trans, SharesItsLightAsTheManualSays) {
  const Trans m{Color(.8, .6, .4), .1, .1, .5, .4};
  const Scattering s = scatter(m, arriving(1), kSampleAll);
  EXPECT_NEAR(s.specularReflection.x, .1, 1e-12) << "uncoloured";
  EXPECT_NEAR(s.diffuseReflection.x, .8 * .9 * .5, 1e-12);
  EXPECT_NEAR(s.diffuseTransmission.x, .8 * .9 * .5 * .6, 1e-12);
  EXPECT_NEAR(s.specularTransmission.x, .8 * .9 * .5 * .4, 1e-12);
  EXPECT_NEAR(s.specularTransmission.z, .4 * .9 * .5 * .4, 1e-12);
}

// -st: a lobe whose share is not above it is not sampled, and counts with the indirect light instead.
TEST(SpecularThreshold, DecidesWhetherLobesAreSampled) {
  const Opaque plastic{Color(.5, .5, .5), .1, .1, false};
  for (const double threshold : {.05, .0999, .1, .2, 1.}) {
    const Scattering s = scatter(plastic, arriving(.7), threshold);
    EXPECT_EQ(s.sampleReflection, threshold < .1);
    EXPECT_NEAR(s.ambientReflection.x, threshold < .1 ? .45 : .55, 1e-12);
    EXPECT_NEAR(s.specularReflection.x, .1, 1e-12) << "direct light sees the lobe in any case";
  }
  const Trans trans{Color(1, 1, 1), 0, .1, .5, .4};
  for (const double threshold : {.1, .1999, .2, 1.}) {
    const Scattering s = scatter(trans, arriving(.7), threshold);
    EXPECT_EQ(s.sampleTransmission, threshold < .2);
    EXPECT_NEAR(s.ambientTransmission.x, threshold < .2 ? .3 : .5, 1e-12);
  }
  const Scattering polished = scatter(Opaque{Color(.5, .5, .5), .1, 0, false}, arriving(.7), 1);
  EXPECT_NE(find(polished, kReflected), nullptr) << "sharp reflections are always followed";
}

// ---- lobes

constexpr double kTiny = 1e-7;  // sr, of a source for which the lobe is a number

double lobeTimesCosine(const Scattering& s, const Interaction& at, const V3d& direction) {
  return directCoefficient(s, at, direction, kTiny, 1).color.x / kTiny;
}

TEST(Lobe, ReflectedIsReciprocal) {
  Random random(25);
  for (int i = 0; i < 1000; ++i) {
    const Opaque m{Color(.3, .3, .3), .4, between(random, .05, .4), false};
    V3d a = randomDirection(random), b = randomDirection(random);
    a.z = std::abs(a.z) + .05, b.z = std::abs(b.z) + .05;
    a.normalize(), b.normalize();
    const auto brdf = [&](const V3d& in, const V3d& out) {
      Interaction at;
      at.direction = -out;
      at.cosine = out.z;
      return lobeTimesCosine(scatter(m, at, kSampleAll), at, in) / in.z;
    };
    // Lobes below 1e-6 are left out on either side.
    EXPECT_NEAR(brdf(a, b), brdf(b, a), 1e-9 * brdf(a, b) + 1e-6);
  }
}

// Samples of a lobe against the density that makes the mean of weight * L the integral of lobe * cosine * L.
template <class SampleLobe, class Weight>
double samplingSigmas(const Interaction& at, const Scattering& sampled, const Scattering& evaluated,
                      SampleLobe sampleLobe, Weight weightOf, double densityFactor, double widest,
                      uint64_t seed) {
  const bool through = sampled.specularTransmission.x > 0;
  const V3d middle = through ? sampled.transmitted : V3d(at.direction.x, at.direction.y, -at.direction.z);
  return rsphere::samplingSigmas(
      middle, widest, seed,
      [&](double u1, double u2, V3d& d) { return sampleLobe(sampled, at, 1, u1, u2, d); },
      [&](const V3d& d) {
        if ((through ? -d.z : d.z) <= 1e-6) return 0.;
        return densityFactor * lobeTimesCosine(evaluated, at, d) / weightOf(d);
      });
}

// Only the lobe, of share 1.
Scattering lobeOf(const Interaction& at, double roughness) {
  Scattering s = scatter(Opaque{Color(0, 0, 0), 1, roughness, false}, at, kSampleAll);
  return s;
}

// A highlight of a textured surface under radiance 1 from above the surface.
double lobeUnderSources(const Scattering& s, const Interaction& at) {
  constexpr int kSteps = 600;  // of the elevation's sine; four times as many of the azimuth
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < 4 * kSteps; ++j) {
      const double z = (i + .5) / kSteps, angle = kPi / 2 * (j + .5) / kSteps, r = std::sqrt(1 - z * z);
      sum += lobeTimesCosine(s, at, V3d(r * std::cos(angle), r * std::sin(angle), z));
    }
  return sum * kPi / 2 / kSteps / kSteps;
}

TEST(Lobe, TexturedSamplesWeighWhatDirectLightHas) {
  Random random(31);
  for (const double cosine : {.9, .4})
    for (const V3d& tilt : {V3d(-.2, 0, 0), V3d(.2, 0, 0), V3d(0, .5, 0)}) {
      Interaction at = arriving(cosine);
      at.perturbation = tilt;
      const Scattering s = lobeOf(at, .2);
      const double exact = lobeUnderSources(s, at);
      Sample weights;
      V3d direction;
      for (int i = 0; i < 4000; ++i)
        weights.add(sampleReflection(s, at, 1, random.uniform(), random.uniform(), direction));
      SCOPED_TRACE(testing::Message() << "cosine " << cosine << " tilt " << tilt.x << ' ' << tilt.y);
      EXPECT_NEAR(weights.mean(), exact, kMostSigmas * weights.standardError() + 1e-3);
      EXPECT_GT(std::abs(weights.mean() - 1.1 * exact), kMostSigmas * weights.standardError() + 1e-3)
          << "a tenth more must be noticed";
    }
}

TEST(Lobe, ReflectedSamplesFollowTheLobeOfDirectLight) {
  for (const double cosine : {1., .7, .3})
    for (const double roughness : {.1, .2, .4}) {
      const Interaction at = arriving(cosine);
      const Scattering s = lobeOf(at, roughness);
      const auto weight = [&](const V3d& d) { return 2 / (1 + at.cosine / d.z); };
      SCOPED_TRACE(testing::Message() << "cosine " << cosine << " roughness " << roughness);
      EXPECT_LT(samplingSigmas(at, s, s, sampleReflection, weight, 1, 1, 26), kMostSigmas);
      EXPECT_GT(samplingSigmas(at, s, s, sampleReflection, weight, 1.05, 1, 26), kMostSigmas)
          << "density times 1.05 must be noticed";
      EXPECT_GT(samplingSigmas(at, s, lobeOf(at, 1.05 * roughness), sampleReflection, weight, 1, 1, 26),
                kMostSigmas)
          << "another roughness must be noticed";
    }
}

// The sampled transmitted lobe and that of direct light are both Gaussians that agree to the order of the
// roughness' square, for light that comes at right angles.
TEST(Lobe, TransmittedSamplesFollowTheLobeOfDirectLight) {
  const Interaction at = arriving(1);
  const auto lobe = [&](double roughness) {
    return scatter(Trans{Color(1, 1, 1), 0, roughness, 1, 1}, at, kSampleAll);
  };
  const auto weight = [](const V3d&) { return 1.; };
  const Scattering s = lobe(.02);
  EXPECT_LT(samplingSigmas(at, s, s, sampleTransmission, weight, 1, .1, 27), kMostSigmas);
  EXPECT_GT(samplingSigmas(at, s, lobe(.021), sampleTransmission, weight, 1, .1, 27), kMostSigmas);
}

TEST(Lobe, SpreadBelowOneKeepsToTheMiddle) {
  const Interaction at = arriving(.6);
  const Scattering s = lobeOf(at, .2);
  V3d direction;
  EXPECT_NEAR(sampleReflection(s, at, 0, .3, .9, direction), 1, 1e-12);
  EXPECT_NEAR((direction - V3d(.8, 0, .6)).length(), 0, 1e-14);
}

// ---- direct light

TEST(DirectCoefficient, OfADiffuseSurfaceIsLamberts) {
  const Opaque white{Color(.7, .7, .7), 0, 0, false};
  const Interaction at = arriving(.5);
  const Scattering s = scatter(white, at, kSampleAll);
  EXPECT_NEAR(directCoefficient(s, at, V3d(.6, 0, .8), .01, 0).color.x, .7 * .8 * .01 / kPi, 1e-15);
  EXPECT_EQ(directCoefficient(s, at, V3d(.6, 0, -.8), .01, 0).color.x, 0);
  const Scattering thin = scatter(Trans{Color(1, 1, 1), 0, 0, .25, 0}, at, kSampleAll);
  EXPECT_NEAR(directCoefficient(thin, at, V3d(.6, 0, .8), .01, 0).color.x, .75 * .8 * .01 / kPi, 1e-15);
  EXPECT_NEAR(directCoefficient(thin, at, V3d(.6, 0, -.8), .01, 0).color.x, .25 * .8 * .01 / kPi, 1e-15);
}

// ---- frames and perturbed normals

TEST(Frame, IsOrthonormalAndRightHanded) {
  Random random(28);
  for (int i = 0; i < 1000; ++i) {
    const V3d z = i < 2 ? V3d(0, 0, i ? 1 : -1) : randomDirection(random);
    const auto [x, y] = frame(z);
    EXPECT_NEAR(x.length(), 1, 1e-14);
    EXPECT_NEAR(y.length(), 1, 1e-14);
    EXPECT_NEAR((x.cross(y) - z).length(), 0, 1e-14);
  }
}

TEST(PerturbedNormal, StaysOnTheSideOfTheRay) {
  Random random(29);
  for (int i = 0; i < 1000; ++i) {
    Interaction at = arriving(between(random, .01, 1));
    at.perturbation = 2. * randomDirection(random);
    double cosine = 0;
    const V3d n = perturbedNormal(at, cosine);
    EXPECT_NEAR(n.length(), 1, 1e-12);
    EXPECT_GE(cosine, 0);
    EXPECT_NEAR(cosine, -n.dot(at.direction), 1e-12);
  }
}

}  // namespace
}  // namespace rsphere
