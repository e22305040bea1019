#include "field/site_interpolation.h"

#include <gtest/gtest.h>

namespace rsphere {
namespace {

// One site sees the place, and its gradient predicts less than no light there: some is left, so that no pixel
// becomes black or negative.
TEST(SitesAround, ExtrapolationLeavesSomeLight) {
  GatherSite site;
  site.point = V3d(0, 0, 0);
  GatheredLight light;
  light.mean = V3f(1, 1, 1);
  for (V3f& change : light.perLength) change = V3f(-1, 0, 0);
  light.reach = 1;
  SitesAround around;
  around.count = 1;
  around.site[0] = &site;
  around.light[0] = &light;
  around.weight[0] = around.served = .25;
  double error = 0;
  EXPECT_NEAR(around.at(V3d(.5, 0, 0), error).mean.x, .5, 1e-6);
  const float left = around.at(V3d(2, 0, 0), error).mean.x;
  EXPECT_GT(left, .02);
  EXPECT_LT(left, .1);
  EXPECT_GT(error, 1) << "which finer cells are tried for";
  EXPECT_NEAR(around.at(V3d(-9, 0, 0), error).mean.x, 10, 1e-5) << "no upper bound";
}

}  // namespace
}  // namespace rsphere
