// The standard errors of cylindrical, semi-cylindrical, hemispherical illuminance, of the faces of a cube and
// of the light vector (kernels.h).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "points/quantities.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

using Numbers = std::array<double, Kernels::kQuantities>;

const V3d kFacing(.6, .8, 0);

Numbers valuesOf(const PointAnswer& a) {
  Numbers values;
  values.fill(std::nan(""));  // a quantity that is forgotten here agrees with nothing
  values[Kernels::cylindrical] = brightness(a.cylindricalIrradiance);
  values[Kernels::semicylindrical] = brightness(a.semicylindricalIrradiance(kFacing));
  values[Kernels::hemispherical] = brightness(a.hemisphericalIrradiance());
  for (size_t i = 0; i < 6; ++i) values[Kernels::faces + i] = brightness(a.facing[i]);
  for (size_t i = 0; i < 3; ++i) values[Kernels::vector + i] = a.lightVector[static_cast<int>(i)];
  return values;
}

// True over stated error of each quantity, root mean squares over points and rotations.
Numbers ratiosOf(const SphereSetting& setting, const std::vector<V3d>& points, uint64_t rotations,
                 int zones = 0) {
  SphereOptions o = setting.options.sphere;
  o.baseDirections = 512;
  o.mostDirections = 1024;
  o.quantityErrors.set();
  o.zones = zones;
  o.azimuth = std::atan2(kFacing.y, kFacing.x) * 180 / kPi;
  std::vector<std::array<Sample, Kernels::kQuantities>> values(points.size()), squares = values;
  for (o.rotation = 1; o.rotation <= rotations; ++o.rotation) {
    const SphereEstimator estimator(*setting.transport, o, true);
    SphereEstimator::Workspace workspace(estimator);
    for (size_t p = 0; p < points.size(); ++p) {
      const PointAnswer answer = estimator.estimate(points[p], workspace);
      const Numbers found = valuesOf(answer);
      for (size_t q = 0; q < found.size(); ++q) {
        values[p][q].add(found[q]);
        squares[p][q].add(std::pow(answer.quantityErrors[q].brightness, 2));
      }
    }
  }
  Numbers ratios;
  for (size_t q = 0; q < ratios.size(); ++q) {
    double off = 0, stated = 0;
    for (size_t p = 0; p < points.size(); ++p) {
      off += values[p][q].variance();
      stated += squares[p][q].mean();
    }
    ratios[q] = std::sqrt(off / stated);
  }
  return ratios;
}

// Within what 24 rotations at a few points can tell, of each quantity and of all together. least: of one of
// them.
void expectHonestQuantities(const Numbers& ratios, double least = .6) {
  double squares = 0;
  for (size_t q = 0; q < ratios.size(); ++q) {
    EXPECT_GT(ratios[q], least) << q;
    EXPECT_LT(ratios[q], 1.5) << q;
    squares += ratios[q] * ratios[q] / static_cast<double>(ratios.size());
  }
  const auto isHonest = [](double ratio) { return ratio > .65 && ratio < 1.3; };
  EXPECT_TRUE(isHonest(std::sqrt(squares))) << std::sqrt(squares);
  EXPECT_FALSE(isHonest(2 * std::sqrt(squares))) << "errors that are stated half as large";
}

const std::vector<V3d> kPointsOfQuantities{V3d(1.5, 1, 1.2), V3d(.5, 3, 1.2), V3d(2.5, 4.5, 2),
                                           V3d(1, .5, .5)};

TEST(QuantityErrors, AreHonestByLamps) {
  const SphereSetting room(
      sceneOf("void plastic white 0 0 5 .6 .6 .6 0 0\nvoid light lamp 0 0 3 40 40 40\n" +
              roomOf("white", V3d(4, 5, 3)) +
              "lamp polygon l 0 0 12 1 2 2.9 1 3 2.9 2 3 2.9 2 2 2.9\nlamp sphere b 0 0 4 3 1 2 .05\n"
              "white polygon t 0 0 12 1 1 .7 2 1 .7 2 2 .7 1 2 .7\n"),
      [](RayOptions& o) { o.ambientBounces = 2; });
  expectHonestQuantities(ratiosOf(room, kPointsOfQuantities, 24));
}

// As for the mean, most of the error is the allowance for occluders outside that no direction has hit
// (unseenVariance()): the sky is uniform.
TEST(QuantityErrors, AreHonestByAWindow) {
  const SphereSetting room(sceneOf(kRoomWithAWindow), [](RayOptions& o) { o.ambientBounces = 2; });
  expectHonestQuantities(ratiosOf(room, kPointsOfQuantities, 24), .35);
}

// Not known to paths from both ends.
TEST(QuantityErrors, AreHonestBehindACrystal) {
  const SphereSetting room(
      sceneOf(kRoomWithAWindow +
              "void dielectric crystal 0 0 5 .9 .9 .9 1.5 0\ncrystal sphere d 0 0 4 2 3 1 .3\n"),
      [](RayOptions& o) { o.ambientBounces = 1; });
  expectHonestQuantities(ratiosOf(room, kPointsOfQuantities, 24, 6));
}

// e belongs to the quantity before it.
TEST(QuantityErrors, HaveTheLetterAfterTheirQuantity) {
  const auto of = [](std::string_view letters) {
    std::string quantities;
    for (const PointQuantity* q : pointQuantities(letters)) quantities += q->isError() ? q->of : '-';
    return quantities;
  };
  EXPECT_EQ(of("ev"), "v-");
  EXPECT_EQ(of("vEeCeH"), "--E-C-");
  EXPECT_EQ(of("HeeSeheueze"), "-HH-S-h-u-z");
  EXPECT_EQ(of("okeZe"), "--vzv");
  EXPECT_TRUE(ownErrors("veEezeZ").none());
  EXPECT_EQ(ownErrors("vueCHe").count(), 3 + 6);
}

}  // namespace
}  // namespace rsphere
