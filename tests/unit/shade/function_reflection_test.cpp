#include "shade/function_reflection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "tests/unit/shade/lobe_sampling.h"

namespace rsphere::function_reflection_test {
namespace {

Color gray(double x) { return Color(x, x, x); }

// What leaves along the ray under unit radiance from everywhere, towards light sources: the coefficient over
// the sphere, by a midpoint rule of equal solid angles. distribution: of the direction to the source, per sr.
template <class Distribution>
Color albedo(const FunctionScattering& s, const Distribution& distribution) {
  constexpr int kRows = 64, kColumns = 32;
  constexpr double kCell = 4 * kPi / (kRows * kColumns);
  Color sum(0, 0, 0);
  for (int i = 0; i < kRows; ++i)
    for (int k = 0; k < kColumns; ++k) {
      const double z = -1 + 2 * (i + .5) / kRows, r = std::sqrt(1 - z * z),
                   angle = 2 * kPi * (k + .5) / kColumns;
      const V3d d(r * std::cos(angle), r * std::sin(angle), z);
      sum += directCoefficient(s, d, kCell, [&] { return distribution(d); }).color;
    }
  return sum;
}

// |z|^n over each hemisphere, which integrates to 1 over it when projected.
struct CosinePower {
  double n = 0;
  Color operator()(const V3d& d) const { return gray((n + 2) / (2 * kPi) * std::pow(std::abs(d.z), n)); }
};

// The manual: functions that integrate to 1 over the projected hemisphere keep the energy balance.
TEST(Energy, NormalizedFunctionsGainNoLight) {
  Random random(51);
  for (int i = 0; i < 1000; ++i) {
    const auto share = [&] { return random.uniform(); };
    const Color color(share(), share(), share());
    FunctionScatterer m{color, share()};
    m.metal = i % 3 == 0;
    if (i % 3 == 1) m.transmissivity = share(), m.transmittedSpecular = share();
    const Interaction at = arriving(between(random, .02, 1));
    const FunctionScattering s = scatter(m, at);
    const CosinePower function{between(random, 0, 8)};
    const Color total = albedo(s, function), indirect = s.ambientReflection + s.ambientTransmission;
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_LE(total[channel], 1.001) << i;
      EXPECT_LE(indirect[channel], 1 + 1e-12) << i;
    }
    const Color spoiled = albedo(s, [&](const V3d& d) { return function(d) * 1.05; });
    EXPECT_GE(spoiled.x, total.x + .049 * s.directionalReflection.x);
  }
}

// All of BRTDfunc's shares are given by the file: those that add up to 1 keep to it.
TEST(Energy, BrtdfuncGivesBackWhatItIsTold) {
  Random random(52);
  for (int i = 0; i < 1000; ++i) {
    double shares[5], sum = 0;
    for (double& s : shares) sum += s = random.uniform();
    for (double& s : shares) s /= sum;
    BrtdFunction m{gray(shares[0]), gray(shares[0]), gray(shares[1])};
    Interaction at = arriving(between(random, .02, 1));
    at.front = i % 2;
    const FunctionScattering s = scatter(m, at);
    const CosinePower function{between(random, 0, 5)};
    // Directional scattering goes to both hemispheres, so half of it to each.
    const Color total = albedo(s, [&](const V3d& d) { return function(d) * (shares[2] / 2); });
    const double sharp = sharpReflection(s, at, {shares[3], 0, 0}).coefficient.color.x +
                         sharpTransmission(s, at, {shares[4], 0, 0}).coefficient.color.x;
    EXPECT_NEAR(total.x + sharp, 1, 2e-3);
  }
}

// The functions' reciprocity is the material's.
TEST(FunctionScattering, OfAReciprocalFunctionIsReciprocal) {
  Random random(53);
  const FunctionScatterer m{gray(.5), .3};
  for (int i = 0; i < 200; ++i) {
    const auto upwards = [&] {
      V3d d = randomDirection(random);
      d.z = std::abs(d.z) + .05;
      return d.normalized();
    };
    const V3d a = upwards(), b = upwards();
    const auto brdf = [&](const V3d& eye, const V3d& light) {
      Interaction at;
      at.direction = -eye;
      at.cosine = eye.z;
      return directCoefficient(scatter(m, at), light, 1e-3, [&] { return gray(eye.z * light.z + .1); })
                 .color.x /
             light.z;
    };
    EXPECT_NEAR(brdf(a, b), brdf(b, a), 1e-15);
  }
}

TEST(FunctionScattering, SharesItsLightAsTheManualSays) {
  FunctionScatterer m{Color(.8, .6, .4), .1};
  m.transmissivity = .5;
  m.transmittedSpecular = .4;
  const FunctionScattering s = scatter(m, arriving(.5));
  EXPECT_NEAR(s.directionalReflection.x, .1, 1e-12) << "uncoloured";
  EXPECT_NEAR(s.directionalReflection.z, .1, 1e-12) << "uncoloured";
  EXPECT_NEAR(s.diffuseReflection.x, .8 * .9 * .5, 1e-12);
  EXPECT_NEAR(s.diffuseTransmission.x, .8 * .9 * .5 * .6, 1e-12);
  EXPECT_NEAR(s.directionalTransmission.x, .8 * .9 * .5 * .4, 1e-12);
  // Indirect light takes what is directional for diffuse.
  EXPECT_NEAR(s.ambientReflection.x, .8 * (1 - .45), 1e-12);
  EXPECT_NEAR(s.ambientTransmission.x, .8 * .45, 1e-12);
  FunctionScatterer metal{Color(.8, .6, .4), .1, true};
  EXPECT_NEAR(scatter(metal, arriving(.5)).directionalReflection.z, .04, 1e-12);
}

TEST(FunctionScattering, AsksNoFunctionWhereItHasNoShare) {
  const FunctionScattering s = scatter(FunctionScatterer{gray(.5), .1}, arriving(.5));
  int asked = 0;
  const auto function = [&] {
    ++asked;
    return gray(1);
  };
  directCoefficient(s, V3d(0, 0, -1), .1, function);
  directCoefficient(s, V3d(1, 0, 0), .1, function);
  EXPECT_EQ(asked, 0);
  directCoefficient(s, V3d(0, 0, 1), .1, function);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(directCoefficient(s, V3d(0, 0, 1), .1, [] { return gray(-1); }).color.x,
            directCoefficient(s, V3d(0, 0, 1), .1, [] { return gray(0); }).color.x)
      << "what is negative counts as nothing";
}

TEST(Brtdfunc, HasFrontAndBack) {
  const BrtdFunction m{gray(.1), gray(.2), gray(.3)};
  Interaction at = arriving(.5);
  at.pattern = gray(.5);
  EXPECT_NEAR(scatter(m, at).diffuseReflection.x, .05, 1e-12);
  at.front = false;
  EXPECT_NEAR(scatter(m, at).diffuseReflection.x, .1, 1e-12);
  EXPECT_NEAR(scatter(m, at).diffuseTransmission.x, .15, 1e-12);
}

}  // namespace
}  // namespace rsphere::function_reflection_test
