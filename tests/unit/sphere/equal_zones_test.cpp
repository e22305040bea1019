#include "sphere/equal_zones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "base/random.h"

namespace rsphere {
namespace {

V3d evenDirection(Random& random) {
  const double z = 1 - 2 * random.uniform(), angle = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(std::max(0., 1 - z * z));
  return V3d(r * std::cos(angle), r * std::sin(angle), z);
}

TEST(EqualZones, AreAsManyAsWanted) {
  for (const size_t count : {1, 2, 3, 4, 5, 6, 7, 10, 33, 145, 1000, 2305}) {
    const EqualZones zones(count);
    EXPECT_EQ(zones.count(), count);
    const std::vector<size_t> rows = zones.rows();
    EXPECT_EQ(std::accumulate(rows.begin(), rows.end(), size_t{0}), count);
    EXPECT_EQ(std::count(rows.begin(), rows.end(), size_t{0}), 0);
    EXPECT_DOUBLE_EQ(zones.solidAngle() * static_cast<double>(count), 4 * std::numbers::pi);
  }
}

TEST(EqualZones, HaveTheirMiddlesInThem) {
  for (const size_t count : {1, 2, 3, 12, 145, 999}) {
    const EqualZones zones(count);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_EQ(zones.zoneAt(zones.middle(i)), i);
      EXPECT_NEAR(zones.middle(i).length(), 1, 1e-12);
    }
  }
}

// Chi squared against equal shares; spoiled, it rejects a zone that is a tenth too large.
TEST(EqualZones, HaveTheSameSolidAngle) {
  constexpr size_t kCount = 60, kTries = 120000;
  const EqualZones zones(kCount);
  Random random(1);
  std::vector<double> found(kCount);
  for (size_t i = 0; i < kTries; ++i) ++found[zones.zoneAt(evenDirection(random))];
  const auto chi2 = [&] {
    double sum = 0;
    for (const double f : found) sum += std::pow(f - kTries / kCount, 2) / (kTries / kCount);
    return sum;
  };
  EXPECT_LT(chi2(), 100);  // 59 degrees of freedom: p = 7e-4
  found[17] *= 1.2;
  EXPECT_GT(chi2(), 100);
}

TEST(EqualZones, AreCompact) {
  const EqualZones zones(400);
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const V3d d = evenDirection(random);
    EXPECT_LT(std::acos(std::min(1., d.dot(zones.middle(zones.zoneAt(d))))), .2);
  }
}

// As the manual says, so that other programs can divide directions alike.
TEST(EqualZones, BeginAtTheAzimuthOfXAndTurnTowardsY) {
  const EqualZones zones(6);
  EXPECT_EQ(zones.rows(), (std::vector<size_t>{1, 4, 1}));
  EXPECT_EQ(zones.zoneAt(V3d(0, 0, 1)), 0);
  EXPECT_EQ(zones.zoneAt(V3d(.8, .6, 0)), 1);
  EXPECT_EQ(zones.zoneAt(V3d(-.6, .8, 0)), 2);
  EXPECT_EQ(zones.zoneAt(V3d(-.8, -.6, 0)), 3);
  EXPECT_EQ(zones.zoneAt(V3d(.6, -.8, 0)), 4);
  EXPECT_EQ(zones.zoneAt(V3d(0, 0, -1)), 5);
  EXPECT_EQ(zones.zoneAt(V3d(1, 0, 0)), 1);
  EXPECT_EQ(zones.zoneAt(V3d(1, -1e-300, 0)), 4);
}

}  // namespace
}  // namespace rsphere
