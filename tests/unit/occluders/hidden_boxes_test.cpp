#include "occluders/hidden_boxes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <thread>

#include "base/random.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

constexpr int kStoreys = 6;
constexpr double kStorey = 3.2;

// A rectangle of 4 x 3 m at this height, or one of its pieces in a form of its own.
using Slab = std::function<std::string(const std::string& material, double z, bool up)>;

std::string polygonOf(const std::string& material, std::vector<V3d> corners, bool up) {
  if (!up) std::reverse(corners.begin(), corners.end());
  std::string text = fmt::format("{} polygon slab 0 0 {}", material, 3 * corners.size());
  for (const V3d& c : corners) text += fmt::format(" {} {} {}", c.x, c.y, c.z);
  return text + "\n";
}

std::string rectangle(const std::string& material, double x0, double y0, double x1, double y1, double z,
                      bool up) {
  return polygonOf(material, {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, up);
}

std::string whole(const std::string& material, double z, bool up) {
  return rectangle(material, 0, 0, 4, 3, z, up);
}

// Tiles in rows; every second row is displaced by half a tile.
std::string tiles(const std::string& material, double z, bool up) {
  std::string text;
  for (int row = 0; row < 7; ++row)
    for (double x = row % 2 ? -.3 : 0; x < 4; x += .6)
      text +=
          rectangle(material, std::max(0., x), 3. * row / 7, std::min(4., x + .6), 3. * (row + 1) / 7, z, up);
  return text;
}

std::string triangles(const std::string& material, double z, bool up) {
  return polygonOf(material, {{0, 0, z}, {4, 0, z}, {2.1, 1.7, z}}, up) +
         polygonOf(material, {{4, 0, z}, {4, 3, z}, {2.1, 1.7, z}}, !up) +  // the others' backs
         polygonOf(material, {{4, 3, z}, {0, 3, z}, {2.1, 1.7, z}}, up) +
         polygonOf(material, {{0, 3, z}, {0, 0, z}, {2.1, 1.7, z}}, up);
}

std::string overlapping(const std::string& material, double z, bool up) {
  return rectangle(material, 0, 0, 2.5, 3, z, up) + rectangle(material, 1.5, 0, 4, 3, z, up);
}

// Four pieces around a stairwell in a corner.
std::string aroundStairs(const std::string& material, double z, bool up) {
  return rectangle(material, 0, 0, 4, 2, z, up) + rectangle(material, 0, 2, 3.2, 3, z, up) +
         rectangle(material, 3.2, 2.8, 4, 3, z, up) + rectangle(material, 3.9, 2, 4, 2.8, z, up);
}

// The same as one polygon with a seam.
std::string seamed(const std::string& material, double z, bool up) {
  return polygonOf(material,
                   {{0, 0, z},
                    {4, 0, z},
                    {4, 3, z},
                    {0, 3, z},
                    {0, 0, z},
                    {3.2, 2, z},
                    {3.2, 2.8, z},
                    {3.9, 2.8, z},
                    {3.9, 2, z},
                    {3.2, 2, z}},
                   up);
}

// Rooms of 4 x 3 x 3 m above one another, with slabs of .2 m.
std::string storeys(const std::string& material, const Slab& slab = whole) {
  std::string text =
      "void plastic wall 0 0 5 .6 .6 .6 0 0\nvoid glass pane 0 0 3 .9 .9 .9\n"
      "void dielectric water 0 0 5 .9 .9 .9 1.33 0\nvoid trans cloth 0 0 7 .5 .5 .5 0 0 .5 0\n";
  for (int k = 0; k < kStoreys; ++k) {
    const double low = kStorey * k, high = low + 3;
    text += slab(material, low, true) + slab(material, high, false);
    text += fmt::format("wall polygon south 0 0 12 0 0 {0} 0 0 {1} 4 0 {1} 4 0 {0}\n", low, high);
    text += fmt::format("wall polygon north 0 0 12 0 3 {0} 4 3 {0} 4 3 {1} 0 3 {1}\n", low, high);
    text += fmt::format("wall polygon west 0 0 12 0 0 {0} 0 3 {0} 0 3 {1} 0 0 {1}\n", low, high);
    text += fmt::format("wall polygon east 0 0 12 4 0 {0} 4 0 {1} 4 3 {1} 4 3 {0}\n", low, high);
    text += fmt::format("wall polygon desk 0 0 12 1 1 {0} 2 1 {0} 2 2 {0} 1 2 {0}\n", low + .75);
  }
  return text;
}

constexpr uint32_t kLamps = 12, kFewMore = 7;  // fewer than 8 more do not pay

// Twelve below the ceiling of each storey.
std::vector<Box3d> lamps() {
  std::vector<Box3d> boxes;
  for (int k = 0; k < kStoreys; ++k)
    for (uint32_t i = 0; i < kLamps; ++i) {
      const V3d corner(.2 + .9 * (i % 4), .2 + .9 * (i / 4), kStorey * k + 2.9);
      boxes.push_back({corner, corner + V3d(.6, .3, 0)});
    }
  return boxes;
}

struct Building {
  explicit Building(const std::string& text, std::vector<Box3d> boxes = lamps())
      : scene(sceneOf(text)),
        tracer(scene, true),
        hidden(std::make_shared<const Blockers>(scene, tracer), std::move(boxes), 8) {}
  Scene scene;
  Tracer tracer;
  HiddenBoxes hidden;

  bool hides(const Box3d& from, const Box3d& to) const {
    std::vector<KnownBlocker> known;
    return hidden.blockers()->hides(from, to, known, true);
  }
};

V3d placeIn(const Box3d& box, Random& random) {
  const V3d size = box.size();
  return box.min + V3d(size.x * random.uniform(), size.y * random.uniform(), size.z * random.uniform());
}

// Of boxes that are hidden from random points, the number of pairs, and of shadow rays that are not blocked.
struct Count {
  int hidden = 0, arrived = 0;
};
Count count(const Building& b) {
  const std::vector<Box3d> boxes = lamps();
  Random random(5);
  Count all;
  for (int n = 0; n < 400; ++n) {
    const V3d point = placeIn(b.tracer.bounds(), random);
    const auto seen = b.hidden.notHiddenFrom(point);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      if (std::binary_search(seen.begin(), seen.end(), i)) continue;
      ++all.hidden;
      for (int ray = 0; ray < 10; ++ray) {
        const V3d way = placeIn(boxes[i], random) - point;
        all.arrived += b.tracer.shadow(point, way.normalized(), way.length(), kNone) != Shadow::blocked;
      }
    }
  }
  return all;
}

// From random points, and from a point of each storey at this distance from the south wall (m).
void expectLampsOfOtherStoreysHidden(const Building& b, double depth) {
  const Count all = count(b);
  EXPECT_EQ(all.arrived, 0);
  // From within slabs, those of neighbours may count.
  EXPECT_GT(all.hidden, 400 * .9 * (kStoreys - 1) * kLamps);
  for (int k = 0; k < kStoreys; ++k)
    EXPECT_LE(b.hidden.notHiddenFrom({3, depth, kStorey * k + 1.2}).size(), kLamps + kFewMore)
        << "storey " << k;
}

TEST(HiddenBoxes, LampsOfOtherStoreysAreHidden) {
  expectLampsOfOtherStoreysHidden(Building(storeys("wall")), 2.5);
}

TEST(HiddenBoxes, PointsOnFacesAndOutsideAreAnswered) {
  const Building b(storeys("wall"));
  const auto onFloor = b.hidden.notHiddenFrom({3, 2.5, 2 * kStorey});
  EXPECT_LE(onFloor.size(), 2 * kLamps);
  for (uint32_t i = 2 * kLamps; i < 3 * kLamps; ++i)
    EXPECT_TRUE(std::binary_search(onFloor.begin(), onFloor.end(), i));
  EXPECT_LE(b.hidden.notHiddenFrom({3, 2.5, 2 * kStorey}, {0, 0, 1}).size(), kLamps + kFewMore);
  EXPECT_LE(b.hidden.notHiddenFrom({3, 2.5, 2 * kStorey + 3}, {0, 0, -1}).size(), kLamps + kFewMore);
  EXPECT_LE(b.hidden.notHiddenFrom({4, 1, 1}).size(), kLamps + kFewMore) << "on the outermost wall";
  EXPECT_EQ(b.hidden.notHiddenFrom({40, 1, 1}).size(), kStoreys * kLamps) << "outside";
}

// Only the desks are opaque.
TEST(HiddenBoxes, NothingIsHiddenByWhatLetsLightPass) {
  for (const char* const slab : {"pane", "cloth"}) {
    const Count all = count(Building(storeys(slab)));
    EXPECT_EQ(all.arrived, 0) << slab;
    EXPECT_LT(all.hidden, 400 * .1 * kStoreys * kLamps) << slab;
  }
}

// A ray could be refracted past the slab.
TEST(HiddenBoxes, NothingHidesBehindWhatRefracts) {
  const Count dry = count(Building(storeys("wall")));
  const Count wet = count(Building(storeys("wall") + "water sphere drop 0 0 4 2 1.5 2 .9\n"));
  EXPECT_EQ(wet.arrived, 0);
  EXPECT_LT(wet.hidden, dry.hidden);
}

// A single slab between two rooms, with and without a hole; polygons that are not convex hide nothing.
TEST(HiddenBoxes, AHoleLetsLightPass) {
  const std::string whole = "wall polygon s 0 0 12 0 0 3 4 0 3 4 3 3 0 3 3\n";
  const std::string seamed =
      "wall polygon s 0 0 30 0 0 3 4 0 3 4 3 3 0 3 3 0 0 3 1 1 3 1 2 3 2 2 3 2 1 3 1 1 3\n";
  const std::string twice = "wall polygon s 0 0 24 0 0 3 4 0 3 4 3 3 0 3 3 0 0 3 4 0 3 4 3 3 0 3 3\n";
  const std::string material = "void plastic wall 0 0 5 .6 .6 .6 0 0\n";
  const Box3d below({.5, .5, 0}, {3.5, 2.5, 2}), above({.5, .5, 4}, {3.5, 2.5, 6});
  EXPECT_TRUE(Building(material + whole).hides(below, above));
  EXPECT_TRUE(Building(material + whole).hides(above, below));
  EXPECT_FALSE(Building(material + seamed).hides(below, above));
  EXPECT_FALSE(Building(material + twice).hides(below, above));
  const Box3d beside({.5, .5, 4}, {4.5, 2.5, 6});
  EXPECT_FALSE(Building(material + whole).hides(below, beside));
  const Box3d through({.5, .5, 2.9}, {3.5, 2.5, 6});
  EXPECT_FALSE(Building(material + whole).hides(below, through));
}

// Slabs of several polygons hide as much as whole ones.
TEST(HiddenBoxes, PiecesOfASlabHideAsOne) {
  for (const Slab slab : {tiles, triangles, overlapping})
    expectLampsOfOtherStoreysHidden(Building(storeys("wall", slab)), 1.5);
}

// Through stairwells, some lamps of other storeys are seen.
TEST(HiddenBoxes, SlabsWithAHoleHideTheRest) {
  for (const Slab slab : {aroundStairs, seamed}) {
    const Building b(storeys("wall", slab));
    const Count all = count(b);
    EXPECT_EQ(all.arrived, 0);
    EXPECT_GT(all.hidden, 400 * .5 * (kStoreys - 1) * kLamps);
  }
}

// Points of walls lie at the edge of the floor, which hides lamps below it from all but those next to it.
TEST(HiddenBoxes, AFloorHidesLampsFromTheWallsAroundIt) {
  Random random(3);
  std::vector<Box3d> boxes;
  for (int i = 0; i < 2000; ++i) boxes.emplace_back(placeIn({{.1, .1, -2}, {3.9, 2.9, -.5}}, random));
  const auto seenFrom = [&](const std::string& floor, const V3d& point, const V3d& front) {
    const Building b("void plastic wall 0 0 5 .6 .6 .6 0 0\n" + floor +
                         "wall polygon south 0 0 12 0 0 0 0 0 3 4 0 3 4 0 0\n"
                         "wall polygon east 0 0 12 4 0 0 4 0 3 4 3 3 4 3 0\n",
                     boxes);
    return b.hidden.notHiddenFrom(point, front).size();
  };
  const std::string floor = "wall polygon floor 0 0 12 0 0 0 4 0 0 4 3 0 0 3 0\n";
  const std::string half = "wall polygon floor 0 0 12 0 0 0 2 0 0 2 3 0 0 3 0\n";
  for (const double z : {.05, .4, 2.9}) {
    EXPECT_EQ(seenFrom(floor, {1.3, 0, z}, {0, 1, 0}), 0) << z;
    EXPECT_EQ(seenFrom(floor, {4, 2.2, z}, {-1, 0, 0}), 0) << z;
    EXPECT_GT(seenFrom(half, {4, 2.2, z}, {-1, 0, 0}), 500) << z;
  }
}

// A slab of four polygons around a rectangular hole.
std::string slabWithHole(const Box3d& hole, double z) {
  const V3d low = hole.min, high = hole.max;
  return rectangle("wall", 0, 0, 4, low.y, z, true) + rectangle("wall", 0, high.y, 4, 3, z, true) +
         rectangle("wall", 0, low.y, low.x, high.y, z, true) +
         rectangle("wall", high.x, low.y, 4, high.y, z, true);
}

// Light that passes the hole of one slab does not pass that of the other.
TEST(HiddenBoxes, SlabsWithHolesHideTogether) {
  const Box3d corner({.4, .4, 0}, {.9, .9, 0}), opposite({3.1, 2.1, 0}, {3.6, 2.6, 0});
  const Box3d below({.5, .5, 0}, {3.5, 2.5, 2}), above({.5, .5, 5}, {3.5, 2.5, 6});
  const auto hides = [&](const Box3d& lower, const Box3d& upper, const std::string& more) {
    const Building b("void plastic wall 0 0 5 .6 .6 .6 0 0\nvoid dielectric water 0 0 5 .9 .9 .9 1.33 0\n" +
                     slabWithHole(lower, 3) + slabWithHole(upper, 4) + more);
    return std::pair(b.hides(below, above), b.hides(above, below));
  };
  EXPECT_EQ(hides(corner, opposite, ""), std::pair(true, true));
  EXPECT_EQ(hides(corner, corner, ""), std::pair(false, false));
  EXPECT_EQ(hides(corner, opposite, "water sphere drop 0 0 4 2 1.5 3.5 .3\n"), std::pair(false, false));
}

// Boxes and slabs with holes at random: what is hidden is not reached by shadow rays.
TEST(HiddenBoxes, NothingPassesTheHolesOfSlabsToWhatIsHidden) {
  Random random(17);
  const auto boxIn = [&](const Box3d& space) {
    Box3d box(placeIn(space, random));
    box.extendBy(placeIn(space, random));
    return box;
  };
  int hidden = 0, reached = 0, together = 0;
  for (int n = 0; n < 120; ++n) {
    std::string text = "void plastic wall 0 0 5 .6 .6 .6 0 0\n";
    for (const double z : {3., 4., 5.}) text += slabWithHole(boxIn({{.3, .3, 0}, {3.7, 2.7, 0}}), z);
    const Building b(text);
    for (int k = 0; k < 10; ++k) {
      const Box3d from = boxIn({{.2, .2, 0}, {3.8, 2.8, 2.9}}), to = boxIn({{.2, .2, 5.1}, {3.8, 2.8, 9}});
      int arrived = 0;
      for (int ray = 0; ray < 300; ++ray) {
        const V3d begin = placeIn(from, random), way = placeIn(to, random) - begin;
        arrived += b.tracer.shadow(begin, way.normalized(), way.length(), kNone) != Shadow::blocked;
      }
      const bool isHidden = b.hides(from, to);
      EXPECT_EQ(isHidden, b.hides(to, from));
      hidden += isHidden;
      reached += isHidden && arrived > 0;
      together += !isHidden && arrived == 0;
    }
  }
  EXPECT_EQ(reached, 0);
  EXPECT_GT(hidden, 300);
  EXPECT_LT(together, 200) << "hidden, but not known to be";
}

// Whatever was asked before, and in how many threads.
TEST(HiddenBoxes, TheSameInAnyOrder) {
  const Building forward(storeys("wall")), backward(storeys("wall"));
  std::vector<V3d> points;
  Random random(9);
  for (int i = 0; i < 300; ++i) points.push_back(placeIn(forward.tracer.bounds(), random));
  std::vector<std::vector<uint32_t>> answers;
  for (const V3d& p : points) {
    const auto seen = forward.hidden.notHiddenFrom(p);
    answers.emplace_back(seen.begin(), seen.end());
  }
  std::vector<std::vector<uint32_t>> others(points.size());
  const auto ask = [&](size_t first) {
    for (size_t i = points.size(); i-- > 0;)
      if (i % 2 == first) {
        const auto seen = backward.hidden.notHiddenFrom(points[i]);
        others[i].assign(seen.begin(), seen.end());
      }
  };
  std::thread one(ask, 0), two(ask, 1);
  one.join();
  two.join();
  EXPECT_EQ(answers, others);
}

TEST(HiddenBoxes, TheWidestRegionThatIsEnough) {
  const Building b(storeys("wall"));
  const V3d point(3, 2.5, 1.2);
  const auto ofSize = [&](size_t most) {
    return b.hidden.widestWhere(point, [=](std::span<const uint32_t> s) { return s.size() <= most; }).size();
  };
  EXPECT_EQ(ofSize(kStoreys * kLamps), kStoreys * kLamps);
  EXPECT_LE(ofSize(0), kLamps + kFewMore);
  EXPECT_LE(ofSize(3 * kLamps), 3 * kLamps);
  EXPECT_GT(ofSize(3 * kLamps), kLamps);
}

}  // namespace
}  // namespace rsphere
