#include "light_paths/near_vertices.h"

#include <gtest/gtest.h>

#include <cmath>

#include "light_paths/light_vertex.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::near_vertices_test {
namespace {

constexpr double kWidth = .3;

V3d placeIn(const V3d& corner, Random& random) {
  return corner + 4. * V3d(random.uniform(), random.uniform(), random.uniform());
}

std::vector<LightVertex> verticesIn(size_t count, const V3d& corner) {
  Random random(3);
  std::vector<LightVertex> vertices;
  for (size_t i = 0; i < count; ++i) {
    const V3d at = placeIn(corner, random);
    LightVertex v{{at.x, at.y, at.z}, {0, 0, 1}};
    v.power = static_cast<float>(.1 + random.uniform());
    v.way = i % 4 == 0 ? LightVertex::diffuse : i % 4 == 1 ? LightVertex::highlight : LightVertex::sharp;
    vertices.push_back(v);
  }
  return vertices;
}

// The cubes' side is the width or more, because few vertices share a cube.
TEST(NearVertices, AllWithinHalfTheSideArePossible) {
  for (const V3d& corner : {V3d(0, 0, 0), V3d(1e6, -1e6, 1e3)}) {
    const std::vector<LightVertex> vertices = verticesIn(1000, corner);
    const auto near = NearVertices::of(vertices, kWidth);
    ASSERT_TRUE(near);
    Random random(5);
    for (int i = 0; i < 200; ++i) {
      const V3d at = placeIn(corner, random);
      const NearVertices::Around around = near->around(at);
      double sum = 0;
      for (const LightVertex& v : vertices) {
        const double probability = around.probabilityOf(v), distance = (v.point() - at).length();
        sum += probability;
        if (!v.isUnbounded()) {
          EXPECT_EQ(probability, 0);
        }
        if (v.isUnbounded() && distance < .5 * kWidth) {
          EXPECT_GT(probability, 0);
        }
        if (distance > 4 * kWidth * std::sqrt(3.)) {
          EXPECT_EQ(probability, 0);
        }
      }
      EXPECT_NEAR(sum, around.empty() ? 0 : 1, 1e-9);
    }
  }
}

TEST(NearVertices, AreDrawnWithTheirProbabilities) {
  const std::vector<LightVertex> vertices = verticesIn(300, V3d(0, 0, 0));
  const auto near = NearVertices::of(vertices, kWidth);
  ASSERT_TRUE(near);
  const NearVertices::Around around = near->around(V3d(2, 2, 2));
  ASSERT_FALSE(around.empty());
  // The mean of the inverse probability is the number of vertices that may be drawn.
  double possible = 0;
  for (const LightVertex& v : vertices) possible += around.probabilityOf(v) > 0;
  Random random(1);
  Sample sample, spoiled;
  for (int i = 0; i < 20000; ++i) {
    const uint32_t drawn = around.draw(random);
    sample.add(1 / around.probabilityOf(vertices[drawn]));
    spoiled.add(vertices[drawn].power > .2 ? 1 / around.probabilityOf(vertices[drawn]) : 0);
  }
  expectMean(sample, possible);
  EXPECT_LT(spoiled.mean() + 4 * spoiled.standardError(), possible);
}

TEST(NearVertices, NoneOutsideAndNoneWithoutUnboundedOnes) {
  std::vector<LightVertex> vertices = verticesIn(100, V3d(0, 0, 0));
  const auto near = NearVertices::of(vertices, kWidth);
  ASSERT_TRUE(near);
  for (const double far : {-1e12, -9., 9., 1e12}) EXPECT_TRUE(near->around(V3d(far, 2, 2)).empty());
  for (LightVertex& v : vertices) v.way = LightVertex::direct;
  EXPECT_FALSE(NearVertices::of(vertices, kWidth));
  EXPECT_FALSE(NearVertices::of({}, kWidth));
}

}  // namespace
}  // namespace rsphere::near_vertices_test
