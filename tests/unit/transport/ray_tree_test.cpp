#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rays/ray_report.h"
#include "tests/unit/transport/transport_fixture.h"

// The rays that an observer is shown.
namespace rsphere::ray_tree_test {
namespace {

// A lamp over a floor, a pane between them, a ball of metal and a mirror.
const std::string kRoom =
    "void light lamp 0 0 3 10 8 5\nlamp sphere bulb 0 0 4 0 0 3 .2\n"
    "void plastic red 0 0 5 .6 .2 .1 .03 .1\nred polygon floor 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0\n"
    "void metal shiny 0 0 5 .7 .8 .9 .9 0\nshiny sphere ball 0 0 4 1 1 1 .5\n"
    "void mirror mir 0 0 3 .9 .9 .8\nmir polygon wall 0 0 12 4 -2 0 4 2 0 4 2 3 4 -2 3\n"
    "void glass gl 0 0 3 .9 .8 .9\ngl polygon pane 0 0 12 -2 -2 0 -2 2 0 -2 2 2 -2 -2 2\n";

struct Shown {
  std::string surface;
  int depth;
  Color value, contribution;
  bool shadow;
};

std::vector<Shown> treeOf(Traced& room, const V3d& origin, const V3d& direction, bool shadows) {
  std::vector<Shown> tree;
  const RayObserver observer = [&](const RayEnd& end, const RayResult& result) {
    const RayAnswer a = branchAnswer(room.prepared(), end, result);
    tree.push_back({a.surface.text(), end.context.depth, result.value.color, a.contribution.color,
                    (end.context.kinds & kShadow) != 0});
  };
  room.color(
      origin, direction, 1, 0,
      {.observer = &observer, .shadows = shadows ? ShownShadows::all : ShownShadows::thatPassSurfaces});
  return tree;
}

// echo -1 0 1 -1 0 -.2 | rtrace -h -ss 0 -oTsvW (RADIANCE 6.1a): eight rays, in this order.
TEST(RayTree, IsThatOfTheOriginal) {
  const std::string plain = "void plastic red 0 0 5 .6 .2 .1 0 0\n";
  std::string text = kRoom;
  text.replace(text.find("void plastic red"), text.find("\nred polygon") - text.find("void plastic red"),
               plain.substr(0, plain.size() - 1));
  RayOptions options;
  options.specularSampling = 0;
  Traced room(text, options);
  const auto tree = treeOf(room, V3d(0, 0, 1), V3d(-1, 0, -.2), true);
  const struct {
    const char* surface;
    int depth;
    Color value, contribution;
  } expected[] = {
      {"bulb", 3, {10, 8, 5}, {2.452877e-04, 6.401788e-05, 4.088128e-05}},
      {"pane", 2, {8.182423, 5.773479, 4.091211}, {2.997739e-04, 8.870613e-05, 4.996232e-05}},
      {"floor", 1, {2.971639e-03, 6.989249e-04, 2.476366e-04}, {8.254288e-01, 7.327582e-01, 8.254288e-01}},
      {"bulb", 2, {10, 8, 5}, {1.689925e-04, 5.125134e-05, 2.816542e-05}},
      {"floor", 1, {2.276840e-02, 6.071574e-03, 1.897367e-03}, {7.422239e-02, 6.752956e-02, 7.422239e-02}},
      {"pane", 0, {4.142802e-03, 9.221537e-04, 3.452335e-04}, {1, 1, 1}},
  };
  ASSERT_EQ(tree.size(), std::size(expected));
  for (size_t i = 0; i < tree.size(); ++i) {
    EXPECT_EQ(tree[i].surface, expected[i].surface);
    EXPECT_EQ(tree[i].depth, expected[i].depth);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(tree[i].value[c], expected[i].value[c], 1e-6 * expected[i].value[c]) << i;
      EXPECT_NEAR(tree[i].contribution[c], expected[i].contribution[c], 1e-6 * expected[i].contribution[c])
          << i;
    }
  }
}

// With -ot instead of -oT, shadow rays are shown only if they pass through a surface.
TEST(RayTree, LeavesOutShadowRaysInTheClear) {
  Traced room(kRoom);
  int through = 0;
  for (const Shown& s : treeOf(room, V3d(0, 0, 1), V3d(-1, 0, -.2), false)) through += s.shadow;
  EXPECT_EQ(through, 2);  // the pane, and the bulb behind it
}

// All light comes from the bulb, so that the contributions of rays to it sum to the value of the primary ray.
TEST(RayTree, ContributionsSumToTheValue) {
  RayOptions options = unbiased(2);
  options.ambientDivisions = 16;
  Traced room(kRoom, options);
  for (const V3d& direction : {V3d(0, 0, -1), V3d(-1, 0, -.2), V3d(1, 1, 0), V3d(1, .1, -.1)}) {
    const auto tree = treeOf(room, V3d(0, 0, 1), direction, true);
    ASSERT_FALSE(tree.empty());
    EXPECT_EQ(tree.back().depth, 0);
    Color sum(0, 0, 0), outside(0, 0, 0);
    for (const Shown& s : tree) {
      if (s.surface == "bulb") sum += s.contribution * s.value;
      if (s.surface == "*") outside += s.value;
    }
    EXPECT_EQ(outside, Color(0, 0, 0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], tree.back().value[c], 1e-5 * tree.back().value[c]);
  }
}

TEST(RayTree, ChangesNoAnswer) {
  Traced room(kRoom, unbiased(2));
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const V3d direction = randomDirection(random);
    const Color before = room.color(V3d(0, 0, 1), direction, 5);
    int shown = 0;
    const RayObserver observer = [&](const RayEnd&, const RayResult&) { ++shown; };
    EXPECT_EQ(room.color(V3d(0, 0, 1), direction, 5, 0,
                         {.observer = &observer,
                          .shadows = i % 2 == 0 ? ShownShadows::all : ShownShadows::thatPassSurfaces}),
              before);
    EXPECT_GT(shown, 0);
  }
}

// Surfaces without a material are passed one by one if each is to be shown to an observer.
TEST(RayTree, ShowsSurfacesOfNothing) {
  Traced room(
      "void polygon a 0 0 12 -1 -1 1 1 -1 1 1 1 1 -1 1 1\nvoid polygon b 0 0 12 -1 -1 2 1 -1 2 1 1 2 -1 1 2\n"
      "void polygon c 0 0 12 -1 -1 3 1 -1 3 1 1 3 -1 1 3\n");
  std::string seen;
  for (const Shown& s : treeOf(room, V3d(0, 0, 0), V3d(0, 0, 1), false)) seen += s.surface;
  EXPECT_EQ(seen, "*cba");
}

}  // namespace
}  // namespace rsphere::ray_tree_test
