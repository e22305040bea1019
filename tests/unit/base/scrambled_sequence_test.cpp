#include "base/scrambled_sequence.h"

#include <gtest/gtest.h>

#include <set>

namespace rsphere {
namespace {

constexpr uint32_t kPoints = 1024;

// How many of 32 x 32 cells of the unit square hold one of as many points. point: gives both coordinates.
template <class Point>
size_t cellsMet(const Point& point) {
  std::set<std::pair<int, int>> met;
  for (uint32_t i = 0; i < kPoints; ++i) {
    const auto [x, y] = point(i);
    EXPECT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1);
    met.insert({static_cast<int>(32 * x), static_cast<int>(32 * y)});
  }
  return met.size();
}

std::pair<double, double> firstTwo(auto& numbers) {
  const double x = numbers.uniform();
  return {x, numbers.uniform()};
}

// In the first two dimensions, each cell holds one point, whichever the seed. Independent points leave a
// third of the cells empty.
TEST(ScrambledPoint, SpreadsEvenly) {
  Random rest(1);
  for (const uint64_t seed : {3, 4, 5})
    EXPECT_EQ(cellsMet([&](uint32_t i) {
                ScrambledPoint point(i, seed, rest);
                return firstTwo(point);
              }),
              kPoints);
  EXPECT_LT(cellsMet([&](uint32_t) { return firstTwo(rest); }), kPoints * 3 / 4);
}

// Each dimension has one point in each of as many strips, and points of different seeds differ.
TEST(ScrambledPoint, CoversEachDimension) {
  Random rest(1);
  std::set<double> firsts;
  for (size_t dimension = 0; dimension < ScrambledPoint::kDimensions; ++dimension) {
    std::set<int> strips;
    for (uint32_t i = 0; i < kPoints; ++i) {
      ScrambledPoint point(i, 7, rest);
      for (size_t skipped = 0; skipped < dimension; ++skipped) point.uniform();
      strips.insert(static_cast<int>(kPoints * point.uniform()));
    }
    EXPECT_EQ(strips.size(), kPoints);
  }
  for (uint64_t seed = 0; seed < 100; ++seed) firsts.insert(ScrambledPoint(0, seed, rest).uniform());
  EXPECT_EQ(firsts.size(), 100u);
}

// Numbers after those of the sequence come from the stream of random numbers.
TEST(ScrambledPoint, GoesOnAtRandom) {
  Random rest(1), same(1);
  ScrambledPoint point(5, 2, rest);
  for (size_t i = 0; i < ScrambledPoint::kDimensions; ++i) point.uniform();
  EXPECT_EQ(point.uniform(), same.uniform());
}

}  // namespace
}  // namespace rsphere
