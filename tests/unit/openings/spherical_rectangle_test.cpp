#include "openings/spherical_rectangle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/constants.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

// 1.5 m wide and .8 m high, at a distance of .7 m from the origin and aside of it.
Rectangle window() { return {V3d(-.2, .7, -.3), V3d(1, 0, 0), V3d(0, 0, 1), V3d(0, -1, 0), 1.5, .8}; }

// The integral of the direction over the rectangle's solid angle is that of Lambert's formula: half the sum
// of the angles of the sides times the normals of the planes through the point and a side.
V3d lightVector(const Rectangle& r, const V3d& point) {
  const std::array<V3d, 4> corners{r.at(0, 0) - point, r.at(1, 0) - point, r.at(1, 1) - point,
                                   r.at(0, 1) - point};
  V3d sum(0, 0, 0);
  for (size_t i = 0; i < 4; ++i) {
    const V3d across = corners[i].cross(corners[(i + 1) % 4]);
    const double angle = std::atan2(across.length(), corners[i].dot(corners[(i + 1) % 4]));
    sum += .5 * angle * across.normalized();
  }
  return sum.dot(corners[0] + corners[2]) < 0 ? -sum : sum;
}

TEST(SphericalRectangle, SamplesUniformlyBySolidAngle) {
  const Rectangle r = window();
  for (const V3d& point : {V3d(0, 0, 0), V3d(.5, .69, .1), V3d(4, -2, 3)}) {
    const SphericalRectangle seen(point, r);
    Random random(1);
    std::array<Sample, 3> vector;
    for (int i = 0; i < 20000; ++i) {
      const double u = random.uniform(), v = random.uniform();
      const V3d direction = seen.sample(u, v);
      EXPECT_NEAR(direction.length(), 1, 1e-12);
      for (int k = 0; k < 3; ++k) vector[k].add(seen.solidAngle() * direction[k]);
    }
    const V3d expected = lightVector(r, point);
    for (int k = 0; k < 3; ++k)
      if (std::abs(expected[k]) > .05 * expected.length()) expectMean(vector[k], expected[k], 1.15);
  }
}

// With half the side lengths a and b, seen from a distance d over the middle:
// 4 asin(ab / sqrt((a2 + d2)(b2 + d2))).
TEST(SphericalRectangle, HasTheSolidAngleOfTheClosedForm) {
  const Rectangle r = window();
  for (const double d : {1e-3, .1, 1., 50.}) {
    const SphericalRectangle seen(r.at(.5, .5) + d * r.normal, r);
    const double a = r.width / 2, b = r.height / 2;
    const double exact = 4 * std::asin(a * b / std::sqrt((a * a + d * d) * (b * b + d * d)));
    EXPECT_NEAR(seen.solidAngle(), exact, 1e-9 + 1e-9 * exact);
  }
}

TEST(SphericalRectangle, IsNotSampledEdgeOn) {
  EXPECT_EQ(SphericalRectangle(V3d(3, .7, 0), window()).solidAngle(), 0);
  EXPECT_EQ(SphericalRectangle(V3d(1e5, 0, 0), window()).solidAngle(), 0);
}

}  // namespace
}  // namespace rsphere
