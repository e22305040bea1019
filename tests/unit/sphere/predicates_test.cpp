#include "sphere/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reference.h"
#include "sets.h"

namespace rsphere {
namespace {

// All orders of four directions must agree: swapping two turns the answer around.
bool agrees(std::array<V3d, 4> d) {
  PredicateCounts counts;
  std::array<int, 4> order = {0, 1, 2, 3};
  const bool first = circleHolds(d[0], d[1], d[2], d[3], counts);
  do {
    int swaps = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) swaps += order[j] > order[i];
    }
    const bool holds = circleHolds(d[order[0]], d[order[1]], d[order[2]], d[order[3]], counts);
    if (holds != (swaps % 2 == 0 ? first : !first)) return false;
  } while (std::next_permutation(order.begin(), order.end()));
  return true;
}

TEST(CircleHolds, EachStageAnswersItsOwn) {
  PredicateCounts counts;
  EXPECT_TRUE(circleHolds(V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1), V3d(1, 1, 1).normalized(), counts));
  EXPECT_FALSE(circleHolds(V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1), V3d(-1, 0, 0), counts));
  EXPECT_EQ(counts.lifted, 2u);

  // Four of a circle about (1, 1, 1), one of them moved by less than long double resolves, also where it has
  // 113 bits, as on arm64.
  const V3d a(0.6, 0.8, 0), b(0, 0.6, 0.8), c(0.8, 0, 0.6), d(0.8, 0.6, 0);
  V3d out = d, in = d;
  out.z = -0x1p-140;
  in.z = 0x1p-140;
  EXPECT_FALSE(circleHolds(a, b, c, out, counts));
  EXPECT_TRUE(circleHolds(a, b, c, in, counts));
  EXPECT_EQ(counts.exact, 2u);

  const bool tie = circleHolds(a, b, c, d, counts);
  EXPECT_EQ(counts.symbolic, 1u);
  EXPECT_EQ(tie, !circleHolds(b, a, c, d, counts));
  EXPECT_EQ(counts.filter, 0u);
}

TEST(CircleHolds, OrdersAgreeAlsoInTies) {
  for (const V3d& d : {V3d(0.8, 0.6, 0), V3d(0, 0.8, 0.6), V3d(0.6, 0, 0.8)}) {
    EXPECT_TRUE(agrees({V3d(0.6, 0.8, 0), V3d(0, 0.6, 0.8), V3d(0.8, 0, 0.6), d}));
  }
  // On one great circle, in each plane and in an oblique one.
  EXPECT_TRUE(agrees({V3d(1, 0, 0), V3d(0, 1, 0), V3d(-1, 0, 0), V3d(0.6, 0.8, 0)}));
  EXPECT_TRUE(agrees({V3d(1, 0, 0), V3d(0, 0, 1), V3d(-1, 0, 0), V3d(0.6, 0, 0.8)}));
  EXPECT_TRUE(agrees({V3d(0, 1, 0), V3d(0, 0, 1), V3d(0, -1, 0), V3d(0, 0.6, 0.8)}));
  const double s = std::sqrt(0.5);
  EXPECT_TRUE(agrees({V3d(s, s, 0), V3d(0, 0, 1), V3d(-s, -s, 0), V3d(0, 0, -1)}));
  // Of different length but the same direction.
  EXPECT_TRUE(agrees({V3d(1, 0, 0), V3d(1 + 0x1p-52, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1)}));
}

TEST(CircleHolds, OrdersAgreeForDegenerateSets) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    auto directions = degenerateSet(seed);
    std::sort(directions.begin(), directions.end(), [](const V3d& a, const V3d& b) {
      return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    });
    directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
    std::mt19937_64 random(seed);
    std::shuffle(directions.begin(), directions.end(), random);
    for (std::size_t i = 3; i < std::min<std::size_t>(directions.size(), 23); ++i) {
      EXPECT_TRUE(agrees({directions[i - 3], directions[i - 2], directions[i - 1], directions[i]}))
          << seed << " " << i;
    }
  }
}

TEST(LengthExcess, MatchesQuadPrecision) {
  // It would not if products and sums were contracted.
  for (const V3d& d : randomDirections(1000, 17)) {
    const Quad x = d.x, y = d.y, z = d.z;
    const Quad right = x * x + y * y + z * z - 1;
    EXPECT_NEAR(lengthExcess(d), static_cast<double>(right), 1e-31);
  }
  EXPECT_EQ(lengthExcess(V3d(1 + 0x1p-52, 0, 0)), 0x1p-51 + 0x1p-104);
}

}  // namespace
}  // namespace rsphere
