#include "silhouettes/silhouette_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

// Balls and triangles of all sizes, near and far, some around the point.
std::vector<Silhouette> regions(int count) {
  Random random(5);
  std::vector<Silhouette> all;
  for (int i = 0; i < count; ++i) {
    const double size = std::exp(between(random, -12, 2));
    const V3d center = randomDirection(random) * between(random, .5, 3);
    if (i % 2) {
      all.push_back(silhouetteOf(Shape(Sphere{center, size}), {}, V3d(0, 0, 0)));
    } else {
      const std::vector<V3d> v{center, center + size * randomDirection(random),
                               center + size * randomDirection(random)};
      all.push_back(silhouetteOf(makePolygon(v, 0, 3), v, V3d(0, 0, 0)));
    }
  }
  return all;
}

TEST(SilhouetteIndex, MissesNoneThatContainsADirection) {
  const std::vector<Silhouette> all = regions(400);
  SilhouetteIndex index;
  for (uint32_t i = 0; i < all.size(); ++i) index.add(i, all[i]);
  Random random(2);
  size_t contained = 0, asked = 0;
  const int directions = 4000;
  for (int k = 0; k < directions; ++k) {
    // Also in the narrow ones, on their edges, and where cells meet.
    const size_t of = static_cast<size_t>(k) % all.size();
    V3d d = randomDirection(random);
    if (k % 3 == 0 && all[of].regionSolidAngle() > 0)
      d = all[of].sample(k % 2 ? random.uniform() : 1, random.uniform());
    if (k % 7 == 0) d = V3d(std::round(3 * d.x), std::round(3 * d.y), std::round(3 * d.z));
    if (d.length() == 0) continue;
    d.normalize();
    const auto near = index.near(d);
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    asked += near.size();
    for (uint32_t i = 0; i < all.size(); ++i) {
      if (!all[i].contains(d)) continue;
      ++contained;
      ASSERT_TRUE(std::binary_search(near.begin(), near.end(), i))
          << "silhouette " << i << ", direction " << d;
    }
  }
  EXPECT_GT(contained, 10000u);
  EXPECT_LT(asked, all.size() * directions / 3) << "most are not asked";
  EXPECT_TRUE(SilhouetteIndex().near(V3d(1, 0, 0)).empty());
}

}  // namespace
}  // namespace rsphere
