#include "points/sampling_strategy.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "sphere/directions.h"

namespace rsphere {
namespace {

TEST(SetAtPoint, TurnsAllDirectionsAlikeButThoseOfTheFirstSet) {
  const std::vector<V3d> directions = baseDirections(50);
  const V3d point(1, 2, 3);
  EXPECT_EQ(SetAtPoint(point, 0, 0).turned(directions), directions);
  const std::vector<V3d> turned = SetAtPoint(point, 1, 0).turned(directions);
  ASSERT_EQ(turned.size(), directions.size());
  EXPECT_GT((turned[0] - directions[0]).length(), 1e-3);
  for (size_t i = 1; i < directions.size(); ++i)
    EXPECT_NEAR(turned[i].dot(turned[0]), directions[i].dot(directions[0]), 1e-14);
}

TEST(SetAtPoint, SeedsDependOnPointSetAndRotation) {
  std::set<uint64_t> seeds;
  for (const double x : {0., 1., -1.})
    for (const uint64_t number : {0, 1, 2})
      for (const uint64_t rotation : {0, 1, 2}) {
        EXPECT_EQ(SetAtPoint(V3d(x, 0, 0), number, rotation).seed(),
                  SetAtPoint(V3d(x, 0, 0), number, rotation).seed());
        seeds.insert(SetAtPoint(V3d(x, 0, 0), number, rotation).seed());
      }
  EXPECT_EQ(seeds.size(), 27u);
}

TEST(SampledSet, MomentsIncludeTheExcess) {
  const BaseSet base{{}, {}, std::nullopt, nullptr};
  SampledSet set;
  set.samples.push_back({V3d(0, 0, 1), 2, Radiance(1)});
  set.excess.add(V3d(1, 0, 0), Irradiance(.5), nullptr);
  EXPECT_EQ(set.moments(base).total.color, Color(2.5, 2.5, 2.5));
  EXPECT_EQ(set.moments(base).facing[0].color, Color(.5, .5, .5));
  EXPECT_EQ(set.moments(base).facing[4].color, Color(2, 2, 2));
}

}  // namespace
}  // namespace rsphere
