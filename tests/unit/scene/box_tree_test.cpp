#include "scene/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/random.h"

namespace rsphere {
namespace {

// Small boxes in a layer. Larger ones among them if mixed.
std::vector<Box3d> layer(size_t count, bool mixed) {
  Random random(3);
  std::vector<Box3d> boxes;
  for (size_t i = 0; i < count; ++i) {
    const V3d center(random.uniform(), random.uniform(), .1 * random.uniform());
    const V3d half(mixed && i % 10 == 0 ? .1 : .001);
    boxes.emplace_back(center - half, center + half);
  }
  return boxes;
}

// The indices of all boxes that are found, in ascending order.
std::vector<uint32_t> foundIn(const BoxTree& tree, FunctionRef<bool(const Box3d&)> mayMeet) {
  std::vector<uint32_t> found;
  EXPECT_FALSE(tree.any(mayMeet, [&](uint32_t i) {
    found.push_back(i);
    return false;
  }));
  std::ranges::sort(found);
  return found;
}

bool isNear(const Box3d& box, const V3d& point, double distance) {
  return Box3d(box.min - V3d(distance), box.max + V3d(distance)).intersects(point);
}

TEST(BoxTree, FindsTheBoxesForWhichTheQuestionHolds) {
  const BoxTree tree(layer(500, true));
  Random random(4);
  size_t all = 0;
  for (int i = 0; i < 200; ++i) {
    const V3d point(random.uniform(), random.uniform(), .1 * random.uniform());
    const auto question = [&](const Box3d& box) { return isNear(box, point, .02); };
    std::vector<uint32_t> wanted;
    for (uint32_t k = 0; k < tree.boxes.size(); ++k)
      if (question(tree.boxes[k])) wanted.push_back(k);
    EXPECT_EQ(foundIn(tree, question), wanted);
    all += wanted.size();
  }
  EXPECT_GT(all, 200u);
}

TEST(BoxTree, StopsAtTheFirstBoxThatIsTaken) {
  const BoxTree tree(layer(100, false));
  size_t calls = 0;
  const auto first = [&](uint32_t) { return ++calls == 1; };
  EXPECT_TRUE(tree.any(Box3d(V3d(0), V3d(1)), first));
  EXPECT_EQ(calls, 1u);
  EXPECT_FALSE(tree.any(Box3d(V3d(2), V3d(3)), first));
}

// A hundred times as many boxes take little longer to search, where no more of them are met.
TEST(BoxTree, SearchesGrowWithTheLogarithm) {
  const auto questions = [](size_t count) {
    const BoxTree tree(layer(count, false));
    size_t asked = 0;
    foundIn(tree, [&](const Box3d& box) {
      ++asked;
      return isNear(box, V3d(.5, .5, .05), 0);
    });
    return asked;
  };
  EXPECT_LT(questions(100000), 4 * questions(1000));
}

TEST(BoxTree, LeavesOutEmptyBoxes) {
  EXPECT_TRUE(foundIn(BoxTree(), [](const Box3d&) { return true; }).empty());
  EXPECT_EQ(foundIn(BoxTree({Box3d(), Box3d(V3d(1))}), [](const Box3d&) { return true; }),
            std::vector<uint32_t>{1});
}

// Boxes in the same place cannot be divided by their centers.
TEST(BoxTree, ManyInTheSamePlace) {
  const BoxTree tree(std::vector<Box3d>(1000, layer(1, false)[0]));
  std::vector<uint32_t> all(1000);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(foundIn(tree, [](const Box3d&) { return true; }), all);
}

}  // namespace
}  // namespace rsphere
