// What polygons do where they meet: no light may leak between them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "scene/shape.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

struct Patchwork {
  std::vector<V3d> vertices;
  std::vector<Polygon> polygons;
  void add(std::initializer_list<V3d> corners) {
    const auto first = static_cast<uint32_t>(vertices.size());
    vertices.insert(vertices.end(), corners);
    polygons.push_back(makePolygon(vertices, first, static_cast<uint32_t>(corners.size())));
  }
  int hitBy(const V3d& origin, const V3d& direction) const {
    int hits = 0;
    ShapeHit hit;
    for (const Polygon& p : polygons) hits += intersect(p, vertices, origin, direction, 1e10, hit);
    return hits;
  }
};

TEST(Polygon, KnowsItsPlaneAndArea) {
  const std::vector<V3d> v = {V3d(1, 2, 3), V3d(4, 2, 3), V3d(4, 2, 5), V3d(1, 2, 5)};
  const Polygon p = makePolygon(v, 0, 4);
  EXPECT_NEAR(areaOf(p, v), 6, 1e-14);
  EXPECT_NEAR((p.normal - V3d(0, -1, 0)).length(), 0, 1e-15);
  EXPECT_NEAR(p.offset, -2, 1e-15);
  EXPECT_EQ(p.axis, 1u);
  EXPECT_EQ(thicknessOf(p, v), 0);
}

TEST(Polygon, KeepsItsAreaFarFromTheOrigin) {
  const V3d place(5e6, -5e6, 5e6);
  const std::vector<V3d> v = {place, place + V3d(1, 0, 0), place + V3d(1, 1, 0), place + V3d(0, 1, 0)};
  EXPECT_NEAR(areaOf(makePolygon(v, 0, 4), v), 1, 1e-12);
  EXPECT_EQ(makePolygon(v, 0, 4).normal, V3d(0, 0, 1));
}

TEST(Polygon, OnALineHasNoAreaAndIsNeverHit) {
  const std::vector<V3d> v = {V3d(0, 0, 0), V3d(1, 0, 0), V3d(2, 0, 0)};
  const Polygon p = makePolygon(v, 0, 3);
  EXPECT_EQ(areaOf(p, v), 0);
  ShapeHit hit;
  EXPECT_FALSE(intersect(p, v, V3d(1, 0, 1), V3d(0, 0, -1), 10, hit));
}

// The mean plane of (0 0 0) (1 0 0) (1 1 h) (0 1 0) goes through (1/2 1/2 h/4).
TEST(Polygon, OfBentVerticesLiesInTheirMeanPlane) {
  const double h = .01;
  const std::vector<V3d> v = {V3d(0, 0, 0), V3d(1, 0, 0), V3d(1, 1, h), V3d(0, 1, 0)};
  const Polygon p = makePolygon(v, 0, 4);
  ShapeHit hit;
  ASSERT_TRUE(intersect(p, v, V3d(.5, .5, 1), V3d(0, 0, -1), 10, hit));
  EXPECT_NEAR(hit.distance, 1 - h / 4, 1e-12);
  EXPECT_NEAR(thicknessOf(p, v), h / 4, h * h);
}

// Rays aimed at a shared edge as closely as doubles allow. Where the polygons are folded, each sees the ray
// in its own plane, at a point rounded its own way.
TEST(Polygon, SharedEdgesLetNoRayThrough) {
  Random random(1);
  for (const double shift : {0., 1e5, 5e6})
    for (const double distance : {2., 1e5}) {
      int through = 0;
      for (int i = 0; i < 20000; ++i) {
        const V3d place(shift, -shift, shift);
        const V3d a = place + randomPoint(random, 1), b = place + randomPoint(random, 1);
        Patchwork patches;
        const V3d c = place + randomPoint(random, 1);
        // Folded by any angle to flat; the other side lies across the edge from c.
        const V3d edge = (b - a).normalized();
        const V3d across = (c - a - edge.dot(c - a) * edge).normalized();
        const V3d up = edge.cross(across);
        const double fold = i % 4 == 0 ? 0 : between(random, -1.2, 1.2);
        const V3d d = (a + b) / 2 + between(random, .3, 1) * (std::sin(fold) * up - std::cos(fold) * across);
        patches.add({a, b, c});
        patches.add({b, a, d});
        const V3d on = a + between(random, .01, .99) * (b - a);
        // From where both are seen: within the wedge that their normals span.
        const V3d out = (patches.polygons[0].normal + patches.polygons[1].normal).normalized();
        const V3d origin = on + distance * (out + .3 * randomDirection(random)).normalized();
        through += patches.hitBy(origin, (on - origin).normalized()) == 0;
      }
      EXPECT_EQ(through, 0) << "shift " << shift << ", seen from " << distance;
    }
}

TEST(Polygon, SharedVerticesLetNoRayThrough) {
  Random random(2);
  for (const double shift : {0., 1e5, 5e6})
    for (const double height : {1., 1e5}) {
      const V3d place(shift, shift, -shift);
      int through = 0;
      for (int i = 0; i < 500; ++i) {
        // A pyramid of 5 sides around its tip, seen from above.
        Patchwork patches;
        std::vector<V3d> rim;
        for (int k = 0; k < 5; ++k)
          rim.push_back(place + V3d(std::cos(k * 1.2566), std::sin(k * 1.2566), -between(random, 0, 1)));
        for (int k = 0; k < 5; ++k) patches.add({place, rim[k], rim[(k + 1) % 5]});
        const V3d origin = place + height * (V3d(0, 0, 1) + .3 * randomDirection(random));
        through += patches.hitBy(origin, (place - origin).normalized()) == 0;
      }
      EXPECT_EQ(through, 0) << "shift " << shift << ", seen from " << height;
    }
}

// What programs write for a disk, or for a sphere's poles.
TEST(Polygon, FanOfAThousandTrianglesIsClosedAtItsApex) {
  for (const double shift : {0., 1e5}) {
    const V3d apex(shift, shift, shift);
    Patchwork patches;
    const auto rim = [&](int k) {
      const double angle = 2 * std::numbers::pi * (k % 1000) / 1000;
      return apex + V3d(std::cos(angle), std::sin(angle), 0);
    };
    for (int k = 0; k < 1000; ++k) patches.add({apex, rim(k), rim(k + 1)});
    Random random(3);
    int through = 0;
    for (int i = 0; i < 1000; ++i) {
      const double angle = 2 * std::numbers::pi * random.uniform();
      const V3d target = apex + 1e-5 * random.uniform() * V3d(std::cos(angle), std::sin(angle), 0);
      const V3d origin = apex + V3d(.2, -.1, 1) + randomPoint(random, .3);
      through += patches.hitBy(origin, (target - origin).normalized()) == 0;
    }
    EXPECT_EQ(through, 0) << "shift " << shift;
  }
}

// Floors of tiles: edges along the axes are where crossings are counted, and ties are most likely.
TEST(Polygon, TiledFloorIsClosed) {
  Patchwork patches;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      patches.add({V3d(i, j, 0), V3d(i + 1, j, 0), V3d(i + 1, j + 1, 0), V3d(i, j + 1, 0)});
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) EXPECT_GE(patches.hitBy(V3d(i / 4., j / 4., 1), V3d(0, 0, -1)), 1);
  // Off the edges, each place belongs to one tile alone.
  Random random(4);
  for (int i = 0; i < 1000; ++i)
    EXPECT_EQ(patches.hitBy(V3d(between(random, 0, 10), between(random, 0, 10), 1), V3d(0, 0, -1)), 1);
}

}  // namespace
}  // namespace rsphere
