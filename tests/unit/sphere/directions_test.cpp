#include "sphere/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere/voronoi.h"

namespace rsphere {
namespace {

using std::numbers::pi;

TEST(BaseDirections, AreasAreNearlyEqual) {
  const auto areas = cellSolidAngles(baseDirections(2048));
  double square = 0, most = 0;
  for (double a : areas) {
    const double off = a / (4 * pi / 2048) - 1;
    square += off * off;
    most = std::max(most, std::abs(off));
  }
  EXPECT_LT(std::sqrt(square / 2048), 0.0056);
  EXPECT_LT(most, 0.06);
}

TEST(BaseDirections, AnySizeIsOfUnitVectors) {
  for (std::size_t n : {0, 1, 2, 3, 10, 777, 100000}) {
    const auto directions = baseDirections(n);
    ASSERT_EQ(directions.size(), n);
    for (const V3d& d : directions) ASSERT_NEAR(d.length(), 1, 4e-16);
  }
  EXPECT_EQ(baseDirections(1000000).size(), 1000000u);
}

TEST(BaseDirections, IntegratesPolynomials) {
  // Means over the sphere: x^2 1/3, x^4 1/5, x^2 y^2 1/15. Weighted by cells.
  const auto directions = baseDirections(2048);
  const auto areas = cellSolidAngles(directions);
  double x = 0, x2 = 0, x4 = 0, x2y2 = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const V3d& d = directions[i];
    const double w = areas[i] / (4 * pi);
    x += w * d.x;
    x2 += w * d.x * d.x;
    x4 += w * std::pow(d.x, 4);
    x2y2 += w * d.x * d.x * d.y * d.y;
  }
  EXPECT_NEAR(x, 0, 1e-5);
  EXPECT_NEAR(x2, 1 / 3.0, 1e-3);
  EXPECT_NEAR(x4, 1 / 5.0, 1e-3);
  EXPECT_NEAR(x2y2, 1 / 15.0, 1e-3);
}

TEST(RandomRotation, IsARotation) {
  EXPECT_EQ(randomRotation(0), Imath::M33d());
  for (std::uint64_t k = 1; k < 200; ++k) {
    const Imath::M33d m = randomRotation(k);
    EXPECT_NEAR(m.determinant(), 1, 1e-15);
    EXPECT_TRUE((m * m.transposed()).equalWithAbsError(Imath::M33d(), 1e-15));
  }
}

TEST(RandomRotation, IsUniform) {
  // Images of z are uniform on the sphere, and so are those of x: mean of each coordinate 0 and of its square
  // 1/3. The standard deviation of the mean is 0.58 and of the mean square 0.30, over the root of n.
  const int n = 20000;
  for (const V3d& axis : {V3d(0, 0, 1), V3d(1, 0, 0), V3d(0.6, 0.8, 0)}) {
    V3d sum(0), squares(0);
    for (int k = 1; k <= n; ++k) {
      const V3d d = axis * randomRotation(k);
      sum += d;
      squares += d * d;
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(sum[i] / n, 0, 4 * 0.58 / std::sqrt(n));
      EXPECT_NEAR(squares[i] / n, 1 / 3.0, 4 * 0.30 / std::sqrt(n));
    }
  }
}

TEST(RotatedDirections, KeepsAnglesAndDependsOnTheNumber) {
  const auto directions = baseDirections(100);
  EXPECT_EQ(rotatedDirections(directions, 0), directions);
  const auto a = rotatedDirections(directions, 1), b = rotatedDirections(directions, 2);
  EXPECT_NE(a, b);
  EXPECT_EQ(a, rotatedDirections(directions, 1));
  for (std::size_t i = 1; i < 100; ++i) EXPECT_NEAR(a[0].dot(a[i]), directions[0].dot(directions[i]), 1e-15);
}

}  // namespace
}  // namespace rsphere
