#include "light/relay_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/random.h"

namespace rsphere {
namespace {

// Small relays in a layer. Larger ones among them if mixed.
std::vector<RelayTree::Bounds> layer(size_t count, bool mixed) {
  Random random(3);
  std::vector<RelayTree::Bounds> relays(count);
  for (size_t i = 0; i < count; ++i) {
    const V3d center(random.uniform(), random.uniform(), .1 * random.uniform());
    relays[i].radius = mixed && i % 10 == 0 ? .1 : .001;
    relays[i].centers.extendBy(center);
    relays[i].corners.extendBy(center - V3d(relays[i].radius, 0, 0));
    relays[i].corners.extendBy(center + V3d(0, relays[i].radius, 0));
  }
  return relays;
}

bool meet(const RelayTree::Bounds& bounds, const V3d& point, double distance) {
  const V3d middle = bounds.centers.center();
  return (point - middle).length() <= bounds.centers.size().length() / 2 + bounds.radius + distance;
}

TEST(RelayTree, FindsEveryRelayThatIsReached) {
  const auto relays = layer(500, true);
  const RelayTree tree(relays);
  Random random(4);
  std::vector<uint32_t> found;
  size_t all = 0, reached = 0;
  for (int i = 0; i < 200; ++i) {
    const V3d point(random.uniform(), random.uniform(), .1 * random.uniform());
    tree.find([&](const RelayTree::Bounds& bounds) { return meet(bounds, point, .02); }, found);
    EXPECT_TRUE(std::ranges::is_sorted(found));
    for (uint32_t k = 0; k < relays.size(); ++k) {
      if (!meet(relays[k], point, .02)) continue;
      ++reached;
      EXPECT_TRUE(std::ranges::binary_search(found, k)) << k;
    }
    all += found.size();
  }
  EXPECT_GT(reached, 200u);
  EXPECT_LT(all, 10 * reached);
}

// The corners of bounds may be what decides.
TEST(RelayTree, BoundsHoldCornersCentersAndRadius) {
  const auto relays = layer(100, true);
  const RelayTree tree(relays);
  std::vector<uint32_t> found;
  for (uint32_t k = 0; k < relays.size(); ++k) {
    tree.find(
        [&](const RelayTree::Bounds& bounds) {
          return bounds.corners.intersects(relays[k].corners.min) &&
                 bounds.corners.intersects(relays[k].corners.max) &&
                 bounds.centers.intersects(relays[k].centers.min) && bounds.radius >= relays[k].radius;
        },
        found);
    EXPECT_TRUE(std::ranges::binary_search(found, k)) << k;
  }
}

// A hundred times as many relays take little longer to search, where no more of them are reached.
TEST(RelayTree, SearchesGrowWithTheLogarithm) {
  const auto questions = [](size_t count) {
    const RelayTree tree(layer(count, false));
    size_t asked = 0;
    std::vector<uint32_t> found;
    const auto at = [&](const RelayTree::Bounds& bounds) {
      ++asked;
      return meet(bounds, V3d(.5, .5, .05), 0);
    };
    tree.find(at, found);
    return asked;
  };
  EXPECT_LT(questions(100000), 4 * questions(1000));
}

TEST(RelayTree, MayBeEmpty) {
  std::vector<uint32_t> found{1};
  RelayTree({}).find([](const RelayTree::Bounds&) { return true; }, found);
  EXPECT_TRUE(found.empty());
}

// Relays in the same place cannot be divided by their centers.
TEST(RelayTree, ManyInTheSamePlace) {
  const RelayTree tree(std::vector<RelayTree::Bounds>(1000, layer(1, false)[0]));
  std::vector<uint32_t> found, all(1000);
  std::iota(all.begin(), all.end(), 0);
  tree.find([](const RelayTree::Bounds&) { return true; }, found);
  EXPECT_EQ(found, all);
}

}  // namespace
}  // namespace rsphere
