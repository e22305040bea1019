#include "sphere/voronoi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "allocations.h"
#include "reference.h"
#include "sets.h"
#include "sphere/directions.h"

namespace rsphere {
namespace {

using std::numbers::pi;

double sumError(std::span<const double> areas) {
  return static_cast<double>(
      std::accumulate(areas.begin(), areas.end(), -4 * std::numbers::pi_v<long double>));
}

// Compares every stride-th cell with the reference: relative error 1e-13, or what half an ulp of input can
// change.
void expectReference(std::span<const V3d> directions, std::span<const double> areas, std::size_t stride = 1) {
  const Reference reference(directions);
  for (std::size_t i = 0; i < directions.size(); i += stride) {
    const Quad right = reference.solidAngle(i);
    const double error = std::abs(static_cast<double>(Quad(areas[i]) - right));
    if (error <= 1e-13 * static_cast<double>(right)) continue;
    EXPECT_LE(error, static_cast<double>(reference.changeByHalfUlp(i)))
        << "direction " << i << ": " << areas[i] << " instead of " << static_cast<double>(right);
  }
}

class HardSet : public testing::TestWithParam<Set> {};

TEST_P(HardSet, CellsMatchQuadPrecision) {
  const auto& directions = GetParam().directions;
  VoronoiWorkspace workspace;
  const auto areas = cellSolidAngles(directions, workspace);
  EXPECT_LE(std::abs(sumError(areas)), 1e-13);
  expectReference(directions, areas, 1 + directions.size() / 200);  // a cell takes milliseconds
}

TEST_P(HardSet, KeptBaseGivesTheSame) {
  const auto& directions = GetParam().directions;
  const auto whole = cellSolidAngles(directions);
  VoronoiWorkspace workspace;
  for (const std::size_t kept : {directions.size() / 3, directions.size() - 1}) {
    const BaseTriangulation base(std::span<const V3d>(directions).first(kept));
    const auto areas = cellSolidAngles(base, std::span<const V3d>(directions).subspan(kept), workspace);
    EXPECT_LE(std::abs(sumError(areas)), 1e-13);
    for (std::size_t i = 0; i < areas.size(); ++i) ASSERT_NEAR(areas[i], whole[i], 2e-13 * whole[i]) << i;
  }
}

TEST_P(HardSet, OrderDoesNotMatter) {
  const auto& directions = GetParam().directions;
  std::vector<std::size_t> order(directions.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(6));
  std::vector<V3d> shuffled;
  for (std::size_t i : order) shuffled.push_back(directions[i]);
  const auto areas = cellSolidAngles(directions), other = cellSolidAngles(shuffled);
  for (std::size_t i = 0; i < order.size(); ++i)
    ASSERT_NEAR(other[i], areas[order[i]], 2e-13 * other[i]) << order[i];
}

INSTANTIATE_TEST_SUITE_P(Voronoi, HardSet, testing::ValuesIn(hardSets()), [](const auto& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Voronoi, RandomDegenerateSetsMatchQuadPrecision) {
  PredicateCounts all;
  VoronoiWorkspace workspace;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto directions = degenerateSet(seed);
    const auto areas = cellSolidAngles(directions, workspace);
    EXPECT_LE(std::abs(sumError(areas)), 1e-13);
    expectReference(directions, areas);
    all.filter += workspace.counts().filter;
    all.lifted += workspace.counts().lifted;
    all.exact += workspace.counts().exact;
    all.symbolic += workspace.counts().symbolic;
  }
  EXPECT_GT(all.filter, 10000u);
  EXPECT_GT(all.lifted, 1000u);
  // The second precision, long double, answers most of these where it has 113 bits, as on arm64.
  EXPECT_GT(all.exact, std::numeric_limits<long double>::digits > 64 ? 0u : 100u);
  EXPECT_GT(all.symbolic, 100u);
}

TEST(Voronoi, AMillionRandomDirections) {
  const auto directions = randomDirections(1000000, 8);
  VoronoiWorkspace workspace;
  const auto areas = cellSolidAngles(directions, workspace);
  EXPECT_LE(std::abs(sumError(areas)), 1e-12);
  expectReference(directions, areas, 499);
}

TEST(Voronoi, ReferenceNoticesADirectionMovedByABillionth) {
  auto directions = randomDirections(100, 9);
  const auto areas = cellSolidAngles(directions);
  directions[0] = (directions[0] + V3d(1e-9, 2e-9, 3e-9)).normalized();
  const double right = static_cast<double>(Reference(directions).solidAngle(0));
  EXPECT_GT(std::abs(areas[0] - right), 1e-11 * right);
}

TEST(Voronoi, ClosedForms) {
  EXPECT_TRUE(cellSolidAngles({}).empty());
  EXPECT_EQ(cellSolidAngles(std::vector{V3d(0, 0, 1)}), std::vector{4 * pi});
  EXPECT_EQ(cellSolidAngles(std::vector{V3d(0, 0, 1), V3d(0, 0, 1)}), (std::vector{2 * pi, 2 * pi}));
  EXPECT_EQ(cellSolidAngles(std::vector{V3d(0, 0, 1), V3d(1, 0, 0)}), (std::vector{2 * pi, 2 * pi}));
  EXPECT_EQ(cellSolidAngles(std::vector{V3d(0, 0, 1), V3d(1, 0, 0), V3d(0, 0, 1)}),
            (std::vector{pi, 2 * pi, pi}));
  const auto three = cellSolidAngles(std::vector{V3d(1, 0, 0), V3d(-1, 0, 0), V3d(0, 1, 0)});
  EXPECT_DOUBLE_EQ(three[0], 1.5 * pi);
  EXPECT_DOUBLE_EQ(three[1], 1.5 * pi);
  EXPECT_DOUBLE_EQ(three[2], pi);
  for (int corners : {4, 6, 8, 12, 20}) {
    for (double area : cellSolidAngles(regularSolid(corners))) EXPECT_NEAR(area, 4 * pi / corners, 1e-14);
  }
}

TEST(Voronoi, RotationDoesNotMatter) {
  const auto directions = randomDirections(1000, 10);
  const auto areas = cellSolidAngles(directions);
  for (std::uint64_t rotation : {1, 2, 3}) {
    const auto rotated = cellSolidAngles(rotatedDirections(directions, rotation));
    // Rounding of the rotated directions: 2e-16 of a radius that is about the root of the area.
    for (std::size_t i = 0; i < areas.size(); ++i)
      ASSERT_NEAR(rotated[i], areas[i], 1e-14 * std::sqrt(areas[i]));
  }
}

TEST(Voronoi, ANewDirectionOnlyTakesFromItsNeighbours) {
  const auto directions = randomDirections(500, 11);
  const BaseTriangulation base(directions);
  const std::vector<double> before = cellSolidAngles(directions);
  VoronoiWorkspace workspace;
  const std::vector<V3d> added = {V3d(0.6, 0, 0.8)};
  const auto areas = cellSolidAngles(base, added, workspace);
  const auto cells = voronoiCells(workspace);
  for (std::uint32_t i = 0; i < 500; ++i) {
    const auto begin = cells.neighbour.begin() + cells.first[500],
               end = cells.neighbour.begin() + cells.first[501];
    if (std::find(begin, end, i) == end) {
      EXPECT_NEAR(areas[i], before[i], 1e-15);
    } else {
      EXPECT_LT(areas[i], before[i]);
    }
  }
}

TEST(Voronoi, CellsAreBoundedByTheNearestDirections) {
  for (const auto& directions :
       {randomDirections(300, 12), degenerateSet(1), degenerateSet(17), regularSolid(8)}) {
    VoronoiWorkspace workspace;
    const auto areas = cellSolidAngles(directions, workspace);
    const auto cells = voronoiCells(workspace);
    ASSERT_EQ(cells.first.size(), directions.size() + 1);
    for (std::uint32_t i = 0; i < directions.size(); ++i) {
      const std::uint32_t begin = cells.first[i], n = cells.first[i + 1] - begin;
      if (cells.mergedInto[i] != i) continue;
      ASSERT_GE(n, 2u);
      double area = 0;
      for (std::uint32_t k = 0; k < n; ++k) {
        const V3d &v = cells.vertex[begin + k], &next = cells.vertex[begin + (k + 1) % n];
        const double nearest = v.dot(directions[i]);
        for (const V3d& d : directions) EXPECT_LE(v.dot(d), nearest + 1e-12);
        EXPECT_NEAR(v.dot(directions[cells.neighbour[begin + k]]), nearest, 1e-12);
        EXPECT_NEAR(v.dot(directions[cells.neighbour[begin + (k + 1) % n]]), nearest, 1e-12);
        area += 2 * std::atan2(directions[i].dot(v.cross(next)),
                               1 + directions[i].dot(v) + v.dot(next) + next.dot(directions[i]));
      }
      const auto sharers = std::count(cells.mergedInto.begin(), cells.mergedInto.end(), i);
      // Half a sphere's wedge is where the fan's formula has no sign.
      if (area > 0 && area < 3) {
        EXPECT_NEAR(area / static_cast<double>(sharers), areas[i], 1e-10);
      }
    }
  }
}

TEST(Voronoi, CellsOfFewDirections) {
  VoronoiWorkspace workspace;
  cellSolidAngles(std::vector{V3d(0, 0, 1)}, workspace);
  EXPECT_EQ(voronoiCells(workspace).first, (std::vector<std::uint32_t>{0, 0}));
  cellSolidAngles(std::vector{V3d(0, 0, 1), V3d(1, 0, 0)}, workspace);
  EXPECT_EQ(voronoiCells(workspace).neighbour, (std::vector<std::uint32_t>{1, 0}));
  cellSolidAngles(std::vector{V3d(0, 0, 1), V3d(1, 0, 0), V3d(0, 1, 0)}, workspace);
  const auto cells = voronoiCells(workspace);
  EXPECT_EQ(cells.neighbour, (std::vector<std::uint32_t>{1, 2, 2, 0, 0, 1}));
  for (std::size_t k = 0; k < cells.vertex.size(); ++k)
    EXPECT_NEAR(std::abs(cells.vertex[k].x), std::sqrt(1 / 3.), 1e-15);
  EXPECT_LT(cells.vertex[0].dot(cells.vertex[1]), -0.999);
}

TEST(Voronoi, NearlyEqualDirectionsOfDifferentLengthShareACell) {
  auto directions = baseDirections(50);
  directions.push_back(V3d(1, 0, 0));
  directions.push_back(V3d(1 + 0x1p-52, 0, 0));
  directions.push_back(V3d(1 - 0x1p-53, 0, 0));
  VoronoiWorkspace workspace;
  const auto areas = cellSolidAngles(directions, workspace);
  EXPECT_EQ(areas[50], areas[51]);
  EXPECT_EQ(areas[50], areas[52]);
  EXPECT_LE(std::abs(sumError(areas)), 1e-13);
}

TEST(Voronoi, CrowdsWithinAnUlpAreAnsweredInTime) {
  std::mt19937_64 random(13);
  auto directions = baseDirections(50);
  const V3d centre(0.48, 0.6, 0.64);
  for (int i = 0; i < 3000; ++i) {
    V3d d = centre;
    for (int axis = 0; axis < 3; ++axis) d[axis] += 0x1p-53 * static_cast<double>(random() % 9) - 0x1p-51;
    directions.push_back(d);
  }
  VoronoiWorkspace workspace;
  const auto areas = cellSolidAngles(directions, workspace);
  EXPECT_LE(std::abs(sumError(areas)), 1e-13);
}

TEST(Voronoi, RefusesWhatIsNotADirection) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const BaseTriangulation base(baseDirections(10));
  VoronoiWorkspace workspace;
  for (const V3d& bad :
       {V3d(0), V3d(1, 1, 0), V3d(nan, 0, 1), V3d(0, 0, inf), V3d(0, 0, 1 + 1e-14), V3d(1e200, 0, 0)}) {
    const std::vector<V3d> directions = {V3d(1, 0, 0), bad};
    EXPECT_THROW(cellSolidAngles(directions), std::invalid_argument);
    EXPECT_THROW(BaseTriangulation{directions}, std::invalid_argument);
    try {
      cellSolidAngles(base, directions, workspace);
      ADD_FAILURE();
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()).find("direction 1: not a unit vector"), 0u) << error.what();
    }
  }
  // The workspace is as good as before.
  EXPECT_LE(std::abs(sumError(cellSolidAngles(base, std::vector{V3d(1, 0, 0)}, workspace))), 1e-13);
  EXPECT_NO_THROW(cellSolidAngles(std::vector{V3d(1, 0, 0), V3d(0, 1 - 4e-15, 0)}));
}

TEST(Voronoi, ComponentsThatUnderflowCountAsZero) {
  const std::vector<V3d> directions = {V3d(0, 0, 1), V3d(1e-200, 0, 1), V3d(5e-324, 1e-300, 1),
                                       V3d(0, 0, -1)};
  const auto areas = cellSolidAngles(directions);
  EXPECT_DOUBLE_EQ(areas[0], 2 * pi / 3);
  EXPECT_EQ(areas[3], 2 * pi);
}

TEST(Voronoi, QueriesDoNotAllocateOnceWarm) {
  const BaseTriangulation base(baseDirections(500));
  const auto first = randomDirections(300, 14), second = randomDirections(250, 15);
  VoronoiWorkspace workspace;
  for (int i = 0; i < 2; ++i) {
    cellSolidAngles(base, first, workspace);
    cellSolidAngles(base, second, workspace);
  }
  const std::size_t before = allocations();
  cellSolidAngles(base, second, workspace);
  cellSolidAngles(base, first, workspace);
  EXPECT_EQ(allocations(), before);
  const std::vector<V3d> copy(first);
  EXPECT_EQ(allocations(), before + 1) << "the counter does not count";
}

}  // namespace
}  // namespace rsphere
