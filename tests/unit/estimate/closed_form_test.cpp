// Fields of radiance whose every quantity is known in closed form at a point with nothing around it (each
// checked by quadrature when it was written down).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "estimate/estimator.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

// F, the irradiances facing +x -x +y -y +z -z, the cylindrical one about z, and the light vector's z (x and y
// are 0).
struct Field {
  const char* radiance;  // of direction (Dx, Dy, Dz), as brightfunc has it
  double integral, facing[6], cylindrical, vector;
  double hemispherical;  // from above
};

PointAnswer under(const Field& field, Weights weights) {
  const Scene scene = sceneOf(std::string("void brightfunc field 2 ") + field.radiance +
                              " . 0 0\nfield glow sky 0 0 4 1 1 1 0\nsky source dome 0 0 4 0 0 1 360\n");
  const Transport transport(scene, RayOptions{}, IrradianceAt::none);
  SphereOptions options;
  options.weights = weights;
  const SphereEstimator estimator(transport, options);
  SphereEstimator::Workspace workspace(estimator);
  return estimator.estimate(V3d(1, 2, 3), workspace);
}

// An even set of 2048 is off by less than this where the field has an edge at the horizon: one cell in 2000
// of the sphere.
constexpr double kTolerance = 4e-3;

void expectField(const Field& field) {
  for (const Weights weights : {Weights::homogeneous, Weights::voronoi, Weights::silhouettes}) {
    SCOPED_TRACE(std::string(field.radiance) + " weights " + std::to_string(static_cast<int>(weights)));
    const PointAnswer a = under(field, weights);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(a.mean.color[channel], field.integral / (4 * kPi), kTolerance / 4);
      EXPECT_NEAR(a.scalarIrradiance.color[channel], field.integral / 4, kTolerance);
      EXPECT_NEAR(a.cylindricalIrradiance.color[channel], field.cylindrical, kTolerance);
      EXPECT_NEAR(a.hemisphericalIrradiance().color[channel], field.hemispherical, kTolerance);
      // Nothing is seen to one side more than to the other.
      EXPECT_NEAR(a.semicylindricalIrradiance(V3d(.6, .8, 0)).color[channel], field.cylindrical, kTolerance);
      for (int face = 0; face < 6; ++face)
        EXPECT_NEAR(a.facing[face].color[channel], field.facing[face], kTolerance) << face;
    }
    EXPECT_NEAR(a.lightVector.x, 0, kTolerance);
    EXPECT_NEAR(a.lightVector.y, 0, kTolerance);
    EXPECT_NEAR(a.lightVector.z, field.vector, kTolerance);
  }
}

TEST(ClosedForm, Uniform) { expectField({"1", 4 * kPi, {kPi, kPi, kPi, kPi, kPi, kPi}, kPi, 0, kPi}); }

TEST(ClosedForm, UpperHalf) {
  const double side = kPi / 2;
  expectField({"if(Dz,1,0)", 2 * kPi, {side, side, side, side, kPi, 0}, side, kPi, 3 * kPi / 4});
}

TEST(ClosedForm, OvercastSky) {
  const double side = kPi / 6 + 4. / 9;
  expectField(
      {"if(Dz,(1+2*Dz)/3,0)", 4 * kPi / 3, {side, side, side, side, 7 * kPi / 9, 0}, side, 7 * kPi / 9,
       19 * kPi / 36});
}

TEST(ClosedForm, LinearInHeight) {
  const double b = .5;
  expectField({"1+.5*Dz",
               4 * kPi,
               {kPi, kPi, kPi, kPi, kPi + 2 * kPi * b / 3, kPi - 2 * kPi * b / 3},
               kPi,
               4 * kPi * b / 3,
               kPi + kPi * b / 3});
}

TEST(ClosedForm, QuadraticAlongX) {
  const double x = 3 * kPi / 2, other = 5 * kPi / 4;
  expectField({"1+Dx*Dx", 16 * kPi / 3, {x, x, other, other, other, other}, 11 * kPi / 8, 0, 4 * kPi / 3});
}

// A small source of radiance 1 in the direction (.6, 0, .8), by the definitions: of its solid angle, a half
// cylinder gets (1 + cos(azimuth)) sin / pi, and a half sphere (1 + cos) / 4.
TEST(ClosedForm, SmallSource) {
  const Scene scene = sceneOf("void light bright 0 0 3 1 1 1 bright source lamp 0 0 4 .6 0 .8 2");
  const Transport transport(scene, RayOptions{}, IrradianceAt::none);
  const SphereEstimator estimator(transport, SphereOptions{});
  SphereEstimator::Workspace workspace(estimator);
  const PointAnswer a = estimator.estimate(V3d(1, 2, 3), workspace);
  const double solidAngle = coneSolidAngle(2);
  const auto semi = [&](const V3d& towards) { return brightness(a.semicylindricalIrradiance(towards)); };
  EXPECT_NEAR(semi({1, 0, 0}), solidAngle * 2 * .6 / kPi, 1e-3 * solidAngle);
  EXPECT_NEAR(semi({0, 1, 0}), solidAngle * .6 / kPi, 1e-3 * solidAngle);
  EXPECT_NEAR(semi({-1, 0, 0}), 0, 1e-3 * solidAngle);
  EXPECT_NEAR(semi({.5, std::sqrt(.75), 0}), solidAngle * 1.5 * .6 / kPi, 1e-3 * solidAngle);
  EXPECT_NEAR(brightness(a.hemisphericalIrradiance()), solidAngle * 1.8 / 4, 1e-3 * solidAngle);
}

// A field that is 1% stronger than the closed form says must not pass.
TEST(ClosedForm, AnErrorOfOnePercentIsSeen) {
  const PointAnswer a = under({"1.01", 0, {}, 0, 0, 0}, Weights::silhouettes);
  EXPECT_GT(std::abs(a.scalarIrradiance.color.x - kPi), kTolerance);
  EXPECT_GT(std::abs(a.facing[4].color.x - kPi), kTolerance);
  EXPECT_GT(std::abs(a.cylindricalIrradiance.color.x - kPi), kTolerance);
  EXPECT_GT(std::abs(a.hemisphericalIrradiance().color.x - kPi), kTolerance);
}

}  // namespace
}  // namespace rsphere
