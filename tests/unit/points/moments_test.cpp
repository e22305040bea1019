#include "points/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

using std::numbers::pi;

TEST(Moments, OfOneDirection) {
  const V3d direction = V3d(2, -3, 6) / 7;
  const Color part(1, 2, 4);
  Moments moments;
  moments.add(direction, Irradiance(part), nullptr);
  const PointAnswer a = moments.answer(V3d(1, 2, 3), 5);
  EXPECT_EQ(a.point, V3d(1, 2, 3));
  EXPECT_EQ(a.directions, 5u);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(a.mean.color[channel], part[channel] / (4 * pi), 1e-15);
    EXPECT_NEAR(a.scalarIrradiance.color[channel], part[channel] / 4, 1e-15);
    EXPECT_NEAR(a.cylindricalIrradiance.color[channel], part[channel] * std::sqrt(13.) / 7 / pi, 1e-15);
    const double facing[6] = {2. / 7, 0, 0, 3. / 7, 6. / 7, 0};
    for (int face = 0; face < 6; ++face)
      EXPECT_NEAR(a.facing[face].color[channel], part[channel] * facing[face], 1e-15) << face;
  }
  EXPECT_NEAR((a.lightVector - brightness(part) * direction).length(), 0, 1e-15);
}

TEST(Moments, AreLinear) {
  const V3d up(0, 0, 1), east(1, 0, 0);
  Moments one, other, both;
  one.add(up, Irradiance(Color(1, 2, 3)), nullptr);
  other.add(east, Irradiance(Color(8, 8, 8)), nullptr);
  both.add(up, Irradiance(Color(1, 2, 3)), nullptr);
  both.add(east, Irradiance(Color(2, 2, 2)), nullptr);
  one.add(other, .25);
  EXPECT_EQ(one.total.color, both.total.color);
  EXPECT_EQ(one.cylindrical.color, both.cylindrical.color);
  for (int face = 0; face < 6; ++face) EXPECT_EQ(one.facing[face].color, both.facing[face].color) << face;
  EXPECT_EQ(one.light, both.light);
}

}  // namespace
}  // namespace rsphere
