#include "light_paths/vertex_clusters.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/constants.h"
#include "light_paths/light_vertex.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::vertex_clusters_test {
namespace {

V3d anyDirection(Random& random) {
  const double z = 2 * random.uniform() - 1, angle = 2 * kPi * random.uniform(), r = std::sqrt(1 - z * z);
  return V3d(r * std::cos(angle), r * std::sin(angle), z);
}

// Vertices on the walls of a room and, far more of them, on a small box in it; `away` from the origin. The
// light of some may have come by a mirror.
std::vector<LightVertex> verticesIn(size_t count, const V3d& away, bool mirrors = false) {
  Random random(7);
  std::vector<LightVertex> vertices;
  while (vertices.size() < count) {
    V3d face(0, 0, 0), at(random.uniform(), random.uniform(), random.uniform());
    const auto axis = static_cast<int>(3 * random.uniform());
    const bool upper = random.uniform() < .5, onBox = random.uniform() < .7;
    at[axis] = upper;
    face[axis] = upper == onBox ? 1 : -1;
    const V3d place = away + (onBox ? V3d(2, 1, .2) + .3 * at : 4. * at);
    LightVertex v{};
    for (int k = 0; k < 3; ++k) {
      v.place[k] = place[k];
      v.facing[k] = static_cast<float>(face[k]);
    }
    v.power = static_cast<float>(.5 + random.uniform());
    v.bounces = static_cast<uint8_t>(1 + 3 * random.uniform());
    if (mirrors && vertices.size() % 5 == 0) v.way = LightVertex::sharp;
    vertices.push_back(v);
  }
  return vertices;
}

struct Clustered {
  std::vector<LightVertex> vertices;
  VertexClusters clusters;

  Clustered(const std::vector<LightVertex>& all, double width, bool uneven = false)
      : Clustered(all, VertexClusters::orderOf(all), width, uneven) {}

 private:
  Clustered(const std::vector<LightVertex>& all, const VertexClusters::Order& order, double width,
            bool uneven)
      : vertices(inOrder(all, order)), clusters(vertices, order.ends, width, uneven) {}
  static std::vector<LightVertex> inOrder(const std::vector<LightVertex>& all,
                                          const VertexClusters::Order& order) {
    std::vector<LightVertex> sorted;
    for (const uint32_t i : order.vertices) sorted.push_back(all[i]);
    return sorted;
  }
};

constexpr double kWidth = .4;

// pi times what a place receives from all vertices, by the bounded kernel where it is bounded.
double received(const std::vector<LightVertex>& vertices, const VertexClusters::Receiver& to) {
  double sum = 0;
  for (const LightVertex& v : vertices) {
    const V3d way = v.point() - to.point;
    const double here = way.dot(to.normal), there = -way.dot(v.normal()), square = way.length2();
    if (here > 0 && there > 0 && v.bounces <= to.bounces)
      sum += v.power * here * there / (square * square + (v.isUnbounded() ? 0 : std::pow(kWidth, 4)));
  }
  return sum;
}

// Mean of what the candidates stand for, relative to what is received. leaveOut: a share of the candidates.
Sample candidatesOver(const Clustered& all, const V3d& away, double leaveOut = 0, int places = 400) {
  Random random(3);
  Sample sample;
  for (int i = 0; i < places; ++i) {
    const V3d point(4 * random.uniform(), 4 * random.uniform(), 4 * random.uniform());
    const VertexClusters::Receiver to{away + point, anyDirection(random), 2};
    const double expected = received(all.vertices, to);
    if (!(expected > 0)) continue;
    double sum = 0;
    for (int k = 0; k < 20; ++k) {
      const VertexClusters::Candidates drawn = all.clusters.draw(to, random);
      for (size_t c = 0; c < drawn.count; ++c)
        if (random.uniform() >= leaveOut) sum += drawn.all[c].weight / drawn.all[c].drawn / 20;
    }
    sample.add(sum / expected);
  }
  return sample;
}

TEST(VertexClusters, CandidatesStandForAllVertices) {
  for (const V3d& away : {V3d(0, 0, 0), V3d(1e6, -1e6, 0)})
    for (const bool uneven : {false, true}) {
      const Clustered all(verticesIn(3000, away), kWidth, uneven);
      SCOPED_TRACE(away.x);
      expectMean(candidatesOver(all, away), 1, 1.02);
    }
}

TEST(VertexClusters, CandidatesStandForVerticesThatAreNotBounded) {
  const Clustered all(verticesIn(3000, V3d(0, 0, 0), true), kWidth);
  expectMean(candidatesOver(all, V3d(0, 0, 0), 0, 2000), 1, 1.02);
}

TEST(VertexClusters, CandidatesThatAreLeftOutAreMissed) {
  const Clustered all(verticesIn(3000, V3d(0, 0, 0)), kWidth);
  const Sample spoiled = candidatesOver(all, V3d(0, 0, 0), .1);
  EXPECT_LT(spoiled.mean() + 4 * spoiled.standardError(), 1);
}

// Most vertices are on a small patch, so that those on the floor of a corridor are in large clusters. A place
// on the wall near the floor gets most of its light from the nearest part of such a cluster. If clusters were
// weighed by the mean distance of their vertices alone, the relative variance would be .66 +- .04.
TEST(VertexClusters, LargeOnesSendMostFromWhereTheyAreNearest) {
  constexpr double kLength = 100;
  Random random(5);
  std::vector<LightVertex> vertices;
  for (int i = 0; i < 10000; ++i) {
    const bool onPatch = i % 10 > 0;
    const double u = random.uniform(), v = random.uniform();
    LightVertex vertex{{(onPatch ? 1 : kLength) * u, (onPatch ? 1 : 3) * v, 0}, {0, 0, 1}};
    vertex.power = 1;
    vertex.bounces = 1;
    vertices.push_back(vertex);
  }
  const Clustered all(vertices, kWidth, true);
  Sample variance;
  for (int i = 0; i < 200; ++i) {
    const VertexClusters::Receiver to{V3d(3 + (kLength - 6) * random.uniform(), 0, .05), V3d(0, 1, 0), 1};
    const double expected = received(all.vertices, to);
    Sample sample;
    for (int k = 0; k < 200; ++k) {
      const VertexClusters::Candidates drawn = all.clusters.draw(to, random);
      double sum = 0;
      for (size_t c = 0; c < drawn.count; ++c) sum += drawn.all[c].weight / drawn.all[c].drawn;
      sample.add(sum / expected);
    }
    variance.add(sample.variance());
  }
  EXPECT_LT(variance.mean(), .55);
}

// Places on a wall a few centimeters below a ceiling, whose vertices are one cluster of 4 m. Light that has
// come by mirrors is not bounded where it is near. If its vertices were sampled by the cluster alone, the
// relative variance would be 39 instead of 2.
TEST(VertexClusters, NearLightFromMirrorsIsSampledOften) {
  Random random(11);
  std::vector<LightVertex> vertices;
  for (int i = 0; i < 1000; ++i) {
    LightVertex vertex{{4 * random.uniform(), 4 * random.uniform(), 0}, {0, 0, -1}};
    vertex.power = 1;
    vertex.way = LightVertex::sharp;
    vertices.push_back(vertex);
  }
  const std::array<uint32_t, 1> ends{1000};
  const VertexClusters clusters(vertices, ends, kWidth, false);
  Sample variance;
  for (int i = 0; i < 100; ++i) {
    const VertexClusters::Receiver to{V3d(4 * random.uniform(), 0, -.02), V3d(0, 1, 0), 1};
    const double expected = received(vertices, to);
    Sample sample;
    for (int k = 0; k < 200; ++k) {
      const VertexClusters::Candidates drawn = clusters.draw(to, random);
      double sum = 0;
      for (size_t c = 0; c < drawn.count; ++c) sum += drawn.all[c].weight / drawn.all[c].drawn;
      sample.add(sum / expected);
    }
    variance.add(sample.variance());
  }
  EXPECT_LT(variance.mean(), 4);
}

TEST(VertexClusters, OrderHasEachVertexOnce) {
  for (const size_t count : {0, 1, 2, 100, 5000}) {
    const VertexClusters::Order order = VertexClusters::orderOf(verticesIn(count, V3d(0, 0, 0)));
    std::vector<uint32_t> sorted = order.vertices;
    std::ranges::sort(sorted);
    ASSERT_EQ(sorted.size(), count);
    for (size_t i = 0; i < count; ++i) ASSERT_EQ(sorted[i], i);
    ASSERT_EQ(order.ends.empty(), count == 0);
    EXPECT_EQ(order.ends.empty() ? 0 : order.ends.back(), count);
    EXPECT_TRUE(std::ranges::is_sorted(order.ends));
  }
}

// All at one place, and with a receiver there: no cluster can be halved, and nothing arrives.
TEST(VertexClusters, VerticesAtOnePlace) {
  std::vector<LightVertex> vertices = verticesIn(50, V3d(0, 0, 0));
  for (LightVertex& v : vertices) v = vertices[0];
  const Clustered all(vertices, kWidth);
  Random random(1);
  const V3d above = vertices[0].point() + vertices[0].normal();
  EXPECT_EQ(all.clusters.draw({vertices[0].point(), vertices[0].normal(), 3}, random).count, 0);
  EXPECT_GT(all.clusters.draw({above, -vertices[0].normal(), 3}, random).count, 0);
}

TEST(VertexClusters, NoVertices) {
  const Clustered none({}, kWidth);
  Random random(1);
  EXPECT_EQ(none.clusters.draw({V3d(0, 0, 0), V3d(0, 0, 1), 3}, random).count, 0);
}

}  // namespace
}  // namespace rsphere::vertex_clusters_test
