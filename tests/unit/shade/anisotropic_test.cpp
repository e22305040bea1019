#include "shade/anisotropic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "tests/unit/shade/lobe_sampling.h"

namespace rsphere {
namespace {

constexpr double kSampleAll = 0;  // -st
constexpr double kTiny = 1e-9;    // sr, of a source for which a lobe is a number
const V3d kAlong(.9, .4, .2);     // a direction of brushing, not within the surface

Color gray(double x) { return Color(x, x, x); }

Anisotropic shiny(double along, double across) {
  Anisotropic m;
  m.specularity = 1;
  m.roughnessAlong = along;
  m.roughnessAcross = across;
  return m;
}
Anisotropic clear(double along, double across) {
  Anisotropic m = shiny(along, across);
  m.color = gray(1);
  m.specularity = 0;
  m.trans = true;
  m.transmissivity = m.transmittedSpecular = 1;
  return m;
}

// The share of the radiance from a direction, per sr.
double scattered(const AnisotropicScattering& s, const Interaction& at, const V3d& toSource) {
  return directCoefficient(s, at.direction, toSource, kTiny, 1).color.x / kTiny;
}
double scattered(const AshikhminScattering& s, const Interaction& at, const V3d& toSource) {
  return directCoefficient(s, at.direction, toSource, kTiny).color.x / kTiny;
}

V3d upwards(Random& random) {
  V3d d = randomDirection(random);
  d.z = std::abs(d.z) + .05;
  return d.normalized();
}
Interaction seenFrom(const V3d& eye) {
  Interaction at;
  at.direction = -eye;
  at.cosine = eye.z;
  return at;
}

TEST(Tangents, AreAlongAndAcrossWithinTheSurface) {
  Random random(31);
  for (int i = 0; i < 1000; ++i) {
    const V3d normal = randomDirection(random),
              direction = between(random, .01, 100) * randomDirection(random);
    const Tangents t = tangents(normal, direction);
    EXPECT_TRUE(t.given);
    EXPECT_NEAR(t.along.length(), 1, 1e-12);
    EXPECT_NEAR(t.across.length(), 1, 1e-12);
    EXPECT_NEAR(t.along.dot(normal), 0, 1e-12);
    EXPECT_NEAR(t.across.dot(normal), 0, 1e-12);
    EXPECT_NEAR(t.across.dot(direction.normalized()), 0, 1e-10);
    EXPECT_GT(t.along.dot(direction), 0);
    const Tangents none = tangents(normal, between(random, -3, 3) * normal);
    EXPECT_FALSE(none.given);
    EXPECT_NEAR(none.along.cross(none.across).dot(normal), 1, 1e-12);
  }
  EXPECT_FALSE(tangents(V3d(0, 0, 1), V3d(0, 0, 0)).given);
}

// ---- against the round lobes of plastic, metal and trans

TEST(Anisotropic, OfEqualRoughnessIsItsRoundKin) {
  Random random(32);
  for (int i = 0; i < 1000; ++i) {
    const Color color(random.uniform(), random.uniform(), random.uniform());
    const double specular = random.uniform(), rough = between(random, .05, .5);
    const double passes = random.uniform(), straight = random.uniform();
    const bool metal = i % 2, trans = i % 3 == 0;
    Interaction at = seenFrom(upwards(random));
    at.pattern = Color(.9, .8, .7);
    at.flat = i % 5 == 0;
    if (i % 7 == 0) at.perturbation = .1 * randomDirection(random);
    Anisotropic m{color, specular, rough, rough, metal, trans, trans ? passes : 0, trans ? straight : 0,
                  kNone};
    if (trans) m.metal = false;
    const double threshold = random.uniform();
    const AnisotropicScattering s = scatter(m, at, kAlong, threshold);
    const Scattering round = trans ? scatter(Trans{color, specular, rough, passes, straight}, at, threshold)
                                   : scatter(Opaque{color, specular, rough, metal}, at, threshold);
    EXPECT_NEAR((s.reflection.ambient - round.ambientReflection).rgb().length(), 0, 1e-12);
    EXPECT_NEAR((s.transmission.ambient - round.ambientTransmission).rgb().length(), 0, 1e-12);
    EXPECT_EQ(s.reflected.sampled, round.sampleReflection);
    EXPECT_EQ(s.transmitted.sampled, round.sampleTransmission);
    const V3d above = upwards(random);
    for (const double size : {1e-9, 1e-3, .1})
      EXPECT_NEAR((directCoefficient(s, at.direction, above, size, .3) -
                   directCoefficient(round, at, above, size, .3))
                      .color.rgb()
                      .length(),
                  0, 1e-5 * size);
    if (!trans) continue;
    // From below, at right angles: elsewhere their lobes differ by more than the order of roughness squared.
    EXPECT_NEAR(directCoefficient(s, at.direction, round.transmitted, 1e-3, 0).color.x,
                directCoefficient(round, at, round.transmitted, 1e-3, 0).color.x, 1e-9);
  }
}

TEST(Anisotropic, WithoutADirectionIsRound) {
  const Interaction at = arriving(.7);
  const AnisotropicScattering s = scatter(shiny(.3, .1), at, V3d(0, 0, 2), kSampleAll);
  const AnisotropicScattering round = scatter(shiny(std::sqrt(.05), std::sqrt(.05)), at, kAlong, kSampleAll);
  EXPECT_TRUE(s.reflected.disoriented);
  EXPECT_FALSE(round.reflected.disoriented);
  EXPECT_FALSE(scatter(shiny(.2, .2), at, V3d(0, 0, 2), kSampleAll).reflected.disoriented);
  Random random(33);
  for (int i = 0; i < 100; ++i) {
    const V3d d = upwards(random);
    EXPECT_NEAR(scattered(s, at, d), scattered(round, at, d), 1e-9);
  }
}

TEST(Anisotropic, HighlightIsLongerAcrossTheFinerRoughness) {
  const Interaction at = arriving(1);
  const AnisotropicScattering s = scatter(shiny(.3, .05), at, V3d(1, 0, 0), kSampleAll);
  EXPECT_GT(scattered(s, at, V3d(.3, 0, 1).normalized()), 10 * scattered(s, at, V3d(0, .3, 1).normalized()));
}

// ---- energy

template <class SampleLobe>
Sample meanWeight(const EllipticLobe& lobe, const Interaction& at, Random& random, SampleLobe sampleLobe) {
  Sample weights;
  V3d direction;
  for (int i = 0; i < 400; ++i)
    weights.add(sampleLobe(lobe, at, 1, random.uniform(), random.uniform(), direction));
  return weights;
}

// All that leaves along the ray under unit radiance from everywhere, by what its parts are sampled for.
void expectNoGain(const AnisotropicScattering& s, const Interaction& at, Random& random) {
  const Sample above = meanWeight(s.reflected, at, random, [](const EllipticLobe& lobe, auto&&... rest) {
    return maxChannel(lobe.share) > 0 ? sampleReflection(lobe, rest...) : 0;
  });
  const Sample below = meanWeight(s.transmitted, at, random, [](const EllipticLobe& lobe, auto&&... rest) {
    return maxChannel(lobe.share) > 0 ? sampleTransmission(lobe, rest...) : 0;
  });
  for (int channel = 0; channel < 3; ++channel) {
    double sum = s.reflection.share[channel] + s.transmission.share[channel];
    for (const SharpPath& p : s.sharp) sum += p.coefficient.color[channel];
    const double r = s.reflected.share[channel], t = s.transmitted.share[channel];
    EXPECT_GE(r, 0);
    EXPECT_GE(t, 0);
    EXPECT_GE(s.reflection.share[channel], -1e-12);
    EXPECT_GE(s.transmission.share[channel], -1e-12);
    sum += r * above.mean() + t * below.mean();
    const double error = std::hypot(r * above.standardError(), t * below.standardError());
    EXPECT_LE(sum, 1 + 1e-9 + kMostSigmas * error) << "channel " << channel;
  }
}

TEST(Energy, NoEllipticHighlightGainsLight) {
  Random random(34);
  for (int i = 0; i < 1000; ++i) {
    const auto share = [&] { return random.uniform(); };
    Interaction at = arriving(between(random, .02, 1));
    at.flat = i % 2;
    SCOPED_TRACE(testing::Message() << "material " << i << ", cosine " << at.cosine);
    Anisotropic m{Color(share(), share(), share()), share(), between(random, .01, .5),
                  between(random, .01, .5)};
    for (const bool metal : {false, true}) {
      m.metal = metal;
      expectNoGain(scatter(m, at, randomDirection(random), kSampleAll), at, random);
    }
    m.metal = false;
    m.trans = true;
    m.transmissivity = share();
    m.transmittedSpecular = share();
    expectNoGain(scatter(m, at, randomDirection(random), kSampleAll), at, random);
  }
}

// WGMDfunc's components add up, so they are given by shares that do not exceed 1.
TEST(Energy, NoWgmdfuncGainsLight) {
  Random random(35);
  for (int i = 0; i < 1000; ++i) {
    Interaction at = arriving(between(random, .02, 1));
    at.front = i % 2;
    double shares[4], sum = 0;
    for (double& s : shares) sum += s = random.uniform();
    for (double& s : shares) s /= sum;
    WgmdFunction m;
    m.diffuseFront = m.diffuseBack = gray(shares[0]);
    m.diffuseTransmitted = gray(shares[1]);
    const auto roughness = [&] { return random.uniform() < .3 ? 0 : between(random, .01, .4); };
    const WgmdComponent reflected{at, shares[2], roughness(), roughness()};
    const WgmdComponent transmitted{at, shares[3], roughness(), roughness()};
    SCOPED_TRACE(testing::Message() << "material " << i << ", cosine " << at.cosine);
    expectNoGain(scatter(m, reflected, transmitted, at, at, randomDirection(random), kSampleAll), at, random);
  }
}

// As documented: at right angles ashik2 keeps to what it is given, at grazing angles it may exceed it by
// Schlick's term.
TEST(Energy, Ashik2ExceedsItsSumByFresnelsRiseAtMost) {
  Random random(36);
  for (int i = 0; i < 1000; ++i) {
    const double cosine = between(random, .02, 1), specular = random.uniform();
    const Interaction at = arriving(cosine);
    const Ashikhmin m{gray(1 - specular), gray(specular), between(random, 0, 300), between(random, 0, 300),
                      kNone};
    const AshikhminScattering s = scatter(m, at, randomDirection(random), kSampleAll);
    const double rise = (1 - specular) * std::pow(1 - cosine, 5);
    EXPECT_NEAR(s.reflection.ambient.x + s.share.x, 1 + rise, 1e-12);
    // Towards light sources: the lobe's integral by its own samples.
    Sample weights;
    V3d d;
    for (int k = 0; k < 200; ++k) {
      const bool above = sampleReflection(s, at, random.uniform(), random.uniform(), d);
      weights.add(above ? std::min(1., d.z / cosine) : 0);
    }
    EXPECT_LE(s.share.x * weights.mean(), specular + rise + kMostSigmas * weights.standardError());
  }
}

// ---- reciprocity

// Lobes below 1e-6 are left out on either side.
void expectReciprocal(double a, double b) { EXPECT_NEAR(a, b, 1e-8 * std::abs(a) + 3e-5); }

TEST(EllipticLobe, IsReciprocal) {
  Random random(37);
  for (int i = 0; i < 1000; ++i) {
    const double along = between(random, .05, .4), across = between(random, .05, .4);
    const V3d a = upwards(random), b = upwards(random);
    const auto brdf = [&](const Anisotropic& m, const V3d& eye, const V3d& light) {
      const Interaction at = seenFrom(eye);
      return scattered(scatter(m, at, kAlong, kSampleAll), at, light) / std::abs(light.z);
    };
    expectReciprocal(brdf(shiny(along, across), a, b), brdf(shiny(along, across), b, a));
    // Through the surface: seen from a, lit from below by -b; and with both ways reversed.
    const Anisotropic through = clear(along, across);
    const auto turned = [](const V3d& v) {
      return V3d(v.x, -v.y, -v.z);
    };  // about x, so that the eye is above
    const Interaction before = seenFrom(a), after = seenFrom(turned(-b));
    const double there = scattered(scatter(through, before, kAlong, kSampleAll), before, -b) / b.z;
    const V3d along2 = turned(kAlong);
    const double back = scattered(scatter(through, after, along2, kSampleAll), after, turned(a)) / a.z;
    expectReciprocal(there, back);
  }
}

TEST(Ashik2, IsReciprocalButForItsFresnelTerm) {
  Random random(38);
  const Ashikhmin white{gray(0), gray(1), 20, 150, kNone}, gold{gray(0), gray(.5), 20, 150, kNone};
  int differ = 0;
  for (int i = 0; i < 1000; ++i) {
    const V3d a = upwards(random), b = upwards(random);
    const auto brdf = [&](const Ashikhmin& m, const V3d& eye, const V3d& light) {
      const Interaction at = seenFrom(eye);
      return scattered(scatter(m, at, kAlong, kSampleAll), at, light) / light.z;
    };
    expectReciprocal(brdf(white, a, b), brdf(white, b, a));
    differ += std::abs(brdf(gold, a, b) - brdf(gold, b, a)) > 1e-3 * brdf(gold, a, b) + 1e-4;
  }
  EXPECT_GT(differ, 0) << "the rise goes by the eye's angle alone";
}

// ---- sampling

double reflectedSigmas(const Interaction& at, const Anisotropic& sampled, const Anisotropic& evaluated,
                       double factor = 1) {
  const AnisotropicScattering s = scatter(sampled, at, kAlong, kSampleAll);
  const AnisotropicScattering e = scatter(evaluated, at, kAlong, kSampleAll);
  const V3d mirrored(at.direction.x, at.direction.y, -at.direction.z);
  return samplingSigmas(
      mirrored, 1, 41,
      [&](double u1, double u2, V3d& d) { return sampleReflection(s.reflected, at, 1, u1, u2, d); },
      [&](const V3d& d) {
        return d.z > 1e-6 ? factor * scattered(e, at, d) * (1 + at.cosine / d.z) / 2 : 0;
      });
}

TEST(EllipticLobe, TexturedSamplesWeighAsThoseOfARoundLobe) {
  for (const V3d& tilt : {V3d(-.2, 0, 0), V3d(.2, 0, 0), V3d(0, .5, 0)}) {
    Interaction at = arriving(.4);
    at.perturbation = tilt;
    const AnisotropicScattering s = scatter(shiny(.2, .2), at, kAlong, kSampleAll);
    const Scattering round = scatter(Opaque{Color(0, 0, 0), 1, .2, false}, at, kSampleAll);
    Random random(43);
    Sample ours, theirs;
    V3d d;
    for (int i = 0; i < 4000; ++i) {
      ours.add(sampleReflection(s.reflected, at, 1, random.uniform(), random.uniform(), d));
      theirs.add(sampleReflection(round, at, 1, random.uniform(), random.uniform(), d));
    }
    SCOPED_TRACE(testing::Message() << "tilt " << tilt.x << ' ' << tilt.y);
    const double error = kMostSigmas * std::hypot(ours.standardError(), theirs.standardError());
    EXPECT_NEAR(ours.mean(), theirs.mean(), error);
    EXPECT_GT(std::abs(ours.mean() - 1.15 * theirs.mean()), error) << "15% more must be noticed";
  }
}

TEST(EllipticLobe, ReflectedSamplesFollowTheLobeOfDirectLight) {
  for (const double cosine : {1., .7, .3}) {
    const Interaction at = arriving(cosine);
    const Anisotropic m = shiny(.3, .12);
    SCOPED_TRACE(testing::Message() << "cosine " << cosine);
    EXPECT_LT(reflectedSigmas(at, m, m), kMostSigmas);
    EXPECT_GT(reflectedSigmas(at, m, m, 1.05), kMostSigmas) << "density times 1.05 must be noticed";
    EXPECT_GT(reflectedSigmas(at, m, shiny(.3, .126)), kMostSigmas) << "another roughness must be noticed";
    EXPECT_GT(reflectedSigmas(at, m, shiny(.12, .3)), kMostSigmas) << "exchanged axes must be noticed";
  }
}

// For light that comes at right angles and small roughness both are the same Gaussian.
TEST(EllipticLobe, TransmittedSamplesFollowTheLobeOfDirectLight) {
  const Interaction at = arriving(1);
  const auto sigmas = [&](const Anisotropic& sampled, const Anisotropic& evaluated) {
    const AnisotropicScattering s = scatter(sampled, at, kAlong, kSampleAll);
    const AnisotropicScattering e = scatter(evaluated, at, kAlong, kSampleAll);
    return samplingSigmas(
        at.direction, .1, 42,
        [&](double u1, double u2, V3d& d) { return sampleTransmission(s.transmitted, at, 1, u1, u2, d); },
        [&](const V3d& d) { return d.z < -1e-6 ? scattered(e, at, d) : 0; });
  };
  EXPECT_LT(sigmas(clear(.025, .01), clear(.025, .01)), kMostSigmas);
  EXPECT_GT(sigmas(clear(.025, .01), clear(.026, .01)), kMostSigmas);
  EXPECT_GT(sigmas(clear(.025, .01), clear(.01, .025)), kMostSigmas);
}

// The directions follow the lobe over its weight in the paper, min(1, cosine out / cosine in), though every
// one of them counts as 1.
TEST(Ashik2, SamplesFollowTheLobeOfDirectLight) {
  const auto sigmas = [](const Interaction& at, const Ashikhmin& sampled, const Ashikhmin& evaluated,
                         double factor) {
    const AshikhminScattering s = scatter(sampled, at, kAlong, kSampleAll);
    const AshikhminScattering e = scatter(evaluated, at, kAlong, kSampleAll);
    const V3d mirrored(at.direction.x, at.direction.y, -at.direction.z);
    return samplingSigmas(
        mirrored, 1, 43,
        [&](double u1, double u2, V3d& d) { return sampleReflection(s, at, u1, u2, d) ? 1 : 0; },
        [&](const V3d& d) {
          return d.z > 1e-6 ? factor * scattered(e, at, d) / std::min(1., d.z / at.cosine) : 0;
        });
  };
  const Ashikhmin m{gray(0), gray(1), 12, 60, kNone};
  for (const double cosine : {1., .7, .3}) {
    const Interaction at = arriving(cosine);
    SCOPED_TRACE(testing::Message() << "cosine " << cosine);
    EXPECT_LT(sigmas(at, m, m, 1), kMostSigmas);
    EXPECT_GT(sigmas(at, m, m, 1.05), kMostSigmas);
    EXPECT_GT(sigmas(at, m, Ashikhmin{gray(0), gray(1), 60, 12, kNone}, 1), kMostSigmas);
  }
}

TEST(EllipticLobe, SpreadBelowOneKeepsToTheMiddle) {
  const Interaction at = arriving(.6);
  const AnisotropicScattering s = scatter(shiny(.3, .1), at, kAlong, kSampleAll);
  V3d direction;
  EXPECT_NEAR(sampleReflection(s.reflected, at, 0, .3, .9, direction), 1, 1e-12);
  EXPECT_NEAR((direction - V3d(.8, 0, .6)).length(), 0, 1e-14);
}

// ---- shares

TEST(Ashik2, IsDarkerTowardsGrazingSources) {
  const Ashikhmin m{gray(.5), gray(0), 10, 10, kNone};
  const Interaction at = arriving(.8);
  const AshikhminScattering s = scatter(m, at, kAlong, kSampleAll);
  for (const double cosine : {.1, .5, 1.})
    EXPECT_NEAR(scattered(s, at, V3d(std::sqrt(1 - cosine * cosine), 0, cosine)),
                .5 * (1 - std::pow(1 - cosine, 5)) * cosine / kPi, 1e-12);
  EXPECT_EQ(scattered(s, at, V3d(.6, 0, -.8)), 0);
}

TEST(SpecularThreshold, GivesUnsampledLobesToADiffuseSurfaceOnly) {
  const Interaction at = arriving(.7);
  Anisotropic m = shiny(.2, .1);
  m.specularity = .1;
  m.color = gray(.5);
  EXPECT_TRUE(scatter(m, at, kAlong, .09).reflected.sampled);
  EXPECT_NEAR(scatter(m, at, kAlong, .09).reflection.ambient.x, .45, 1e-12);
  EXPECT_FALSE(scatter(m, at, kAlong, .1).reflected.sampled);
  EXPECT_NEAR(scatter(m, at, kAlong, .1).reflection.ambient.x, .55, 1e-12);
  m.color = gray(0);
  EXPECT_EQ(scatter(m, at, kAlong, .1).reflection.ambient.x, 0) << "as in the original";
  // ashik2 and WGMDfunc go by luminance.
  const Ashikhmin blue{gray(.2), Color(0, 0, 1), 5, 5, kNone};
  EXPECT_TRUE(scatter(blue, at, kAlong, .06).sampled);
  EXPECT_FALSE(scatter(blue, at, kAlong, .07).sampled);
}

TEST(Wgmdfunc, MirrorsTakeFromTheRestWhatTheirFresnelRiseAdds) {
  const Interaction at = arriving(.2);
  WgmdFunction m;
  m.diffuseFront = gray(.3);
  m.diffuseBack = gray(.1);
  m.diffuseTransmitted = gray(.2);
  const WgmdComponent mirror{at, .1, 0, .3}, pane{at, .3, 0, 0};
  const AnisotropicScattering s = scatter(m, mirror, pane, at, at, kAlong, kSampleAll);
  const double rise = std::exp(-5.85 * .2) - .00202943064;
  EXPECT_NEAR(s.reflection.share.x, .3 * (1 - rise), 1e-12);
  EXPECT_NEAR(s.transmission.share.x, .2 * (1 - rise), 1e-12);
  ASSERT_EQ(s.sharp.count, 2u);
  EXPECT_EQ(s.sharp.path[0].kind, kTransmitted);
  EXPECT_NEAR(s.sharp.path[0].coefficient.color.x, .3 * (1 - rise), 1e-12);
  EXPECT_EQ(s.sharp.path[1].kind, kReflected);
  EXPECT_NEAR(s.sharp.path[1].coefficient.color.x, .1 + .9 * rise, 1e-12);
  EXPECT_EQ(s.reflected.share, Color(0, 0, 0));
  // Too weak a mirror is no polished surface.
  const AnisotropicScattering weak =
      scatter(m, WgmdComponent{at, .017, 0, 0}, pane, at, at, kAlong, kSampleAll);
  EXPECT_NEAR(weak.reflection.share.x, .3, 1e-12);
  Interaction behind = at;
  behind.front = false;
  const AnisotropicScattering back = scatter(m, {}, {}, behind, behind, kAlong, kSampleAll);
  EXPECT_EQ(back.reflection.share.x, .1);
  EXPECT_EQ(back.sharp.count, 0u);
}

// Light that is bent on its way through a bumpy sheet comes back the way it went.
TEST(Wgmdfunc, BendsBothWaysAlike) {
  Random random(44);
  for (int i = 0; i < 100; ++i) {
    const V3d bump = .1 * randomDirection(random);
    const auto through = [&](const V3d& direction, bool front) {
      Interaction at;
      at.direction = direction;
      at.front = front;
      at.normal = V3d(0, 0, front ? 1 : -1);
      at.cosine = -direction.dot(at.normal);
      at.perturbation = front ? bump : -bump;
      const WgmdComponent pane{at, .5, 0, 0};
      return scatter(WgmdFunction{}, {}, pane, at, at, kAlong, kSampleAll).sharp.path[0].direction;
    };
    const V3d there = -upwards(random);
    const V3d beyond = through(there, true);
    if (there.z > -.4) continue;  // bends of grazing rays are limited
    EXPECT_NEAR((through(-beyond, false) + there).length(), 0, .02);
  }
}

}  // namespace
}  // namespace rsphere
