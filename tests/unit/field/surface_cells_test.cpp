#include "field/surface_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// The shapes are far enough apart that a ray towards one hits no other.
constexpr const char* kShapes = R"(
void plastic gray 0 0 5 .5 .5 .5 0 0
gray polygon rectangle 0 0 12 0 0 0 5 0 0 5 3 0 0 3 0
gray polygon notched 0 0 18 0 0 10 4 0 10 4 1 10 1 1 10 1 3 10 0 3 10
gray polygon slanted 0 0 9 20 0 1 23 1 2 21 4 4
gray ring disk 0 0 8 30 0 0 1 1 2 0 2
gray ring washer 0 0 8 40 0 0 0 -1 1 .7 2
gray sphere ball 0 0 4 50 0 0 1.5
gray cone stump 0 0 8 60 0 0 60 1 3 2 1
)";

// The hit of a ray from a random place beside the surface towards its middle.
struct Met {
  SurfacePlace place;
  V3d from{0, 0, 0};
};

std::vector<Met> placesOn(const Traced& t, SurfaceId surface, const V3d& middle, int count) {
  std::vector<Met> found;
  Random random(3);
  while (static_cast<int>(found.size()) < count) {
    const V3d towards = middle + randomPoint(random, 2.5), direction = randomDirection(random);
    const V3d from = towards - 4. * direction;
    const Hit hit = t.prepared().tracer().nearest(from, direction);
    if (hit.surface != surface) continue;
    SurfacePlace place{from + hit.distance * direction, V3d(0, 0, 1), surface, nullptr, hit.distance};
    place.normal = hit.normal.dot(direction) > 0 ? -hit.normal : hit.normal;
    found.push_back({place, from});
  }
  return found;
}

const V3d kMiddles[] = {V3d(2.5, 1.5, 0), V3d(1, 1, 10), V3d(21.3, 1.6, 2.3), V3d(30, 0, 0),
                        V3d(40, 0, 0),    V3d(50, 0, 0), V3d(60, .5, 1.5)};

TEST(CellGrid, SidesHalveFromLevelToLevel) {
  Box3d bounds;
  bounds.extendBy(V3d(-1, 2, 0));
  bounds.extendBy(V3d(7, 4, 3));
  const CellGrid grid(bounds);
  EXPECT_EQ(grid.size, 8);
  EXPECT_EQ(grid.origin, V3d(-1, 2, 0));
  EXPECT_GT(grid.lift, 0);
  for (int level = 0; level < CellGrid::kLevels; ++level) {
    EXPECT_EQ(grid.side(level + 1), grid.side(level) / 2);
    EXPECT_EQ(grid.levelOf(grid.side(level)), level);
    EXPECT_EQ(grid.levelOf(1.01 * grid.side(level)), level) << "the first whose cells are not larger";
    EXPECT_EQ(grid.levelOf(.99 * grid.side(level)), level + 1);
  }
  EXPECT_EQ(grid.levelOf(100), 0);
  EXPECT_EQ(grid.levelOf(0), CellGrid::kLevels);
  EXPECT_GT(CellGrid(Box3d()).size, 0) << "an empty scene";
}

// A ray from a site straight down hits the surface that the cell belongs to, at a distance of the lift. The
// site is on the side that the place was seen from.
TEST(SurfaceCells, SitesLieAboveTheirSurfaces) {
  const Traced t(kShapes);
  const CellGrid grid(t.prepared().tracer().bounds());
  for (const SurfaceId s : t.scene().surfaces.ids()) {
    int without = 0, all = 0;
    for (const auto& [place, from] : placesOn(t, s, kMiddles[s.index()], 60)) {
      const auto chart = SurfaceChart::of(t.scene(), grid, place);
      const bool within = s.index() >= 5 && (place.point - kMiddles[s.index()]).dot(place.normal) < 0;
      ASSERT_EQ(chart.has_value(), !within) << t.scene().surfaceName(t.scene().surfaces[s]);
      if (!chart) continue;
      for (const int level : {3, 5, 7, 9}) {
        ++all;
        const auto site = chart->site(grid, chart->cellAt(grid, level, chart->u(), chart->v()));
        if (!site) {
          ++without;
          continue;
        }
        EXPECT_NEAR(site->normal.length(), 1, 1e-12);
        const Hit hit = t.prepared().tracer().nearest(site->point, -site->normal);
        EXPECT_EQ(hit.surface, s);
        EXPECT_NEAR(hit.distance, grid.lift, 1e-3 * grid.lift);
        if (s.index() < 5) {
          EXPECT_NEAR((site->normal - place.normal).length(), 0, 1e-9);
          EXPECT_GT(site->normal.dot(from - site->point), 0);
        }
        // The site and the place lie in the same cell.
        EXPECT_LE((site->point - place.point).length(),
                  1.01 * std::hypot(chart->stepU(grid, level), chart->stepV(grid, level)) + grid.lift);
      }
    }
    if (s.index() == 0 || s.index() >= 5)
      EXPECT_EQ(without, 0) << "cells of rectangles, balls and cones are whole";
    else
      EXPECT_LT(without, .15 * all);
  }
}

TEST(SurfaceCells, CellsAreEqualPartsAndTheirNumbersEndAtTheEdges) {
  const Traced t(kShapes);
  const CellGrid grid(t.prepared().tracer().bounds());
  const SurfacePlace place{V3d(1, 2, 0), V3d(0, 0, 1), SurfaceId(0), nullptr, 1};
  const auto chart = SurfaceChart::of(t.scene(), grid, place);
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->extent(), 5);
  for (const int level : {2, 4, 6, 8}) {
    const double across = 5 / chart->stepU(grid, level), along = 3 / chart->stepV(grid, level);
    EXPECT_NEAR(across, std::round(across), 1e-9);
    EXPECT_NEAR(along, std::round(along), 1e-9);
    EXPECT_LE(chart->stepU(grid, level), grid.side(level));
    EXPECT_LE(chart->stepV(grid, level), grid.side(level));
    EXPECT_EQ(chart->cell(grid, level, -3, 1 << 30).i, 0);
    EXPECT_EQ(chart->cell(grid, level, -3, 1 << 30).j, std::llround(along) - 1);
  }
}

// A key identifies a surface, its side and a cell of it: all places in the cell have the same key, and all
// others have another.
// The rectangle of 5 x 3 is divided across into at least 7 parts, and along as before.
TEST(SurfaceCells, StripsAreDividedAcross) {
  const Traced t(kShapes);
  const CellGrid grid(t.prepared().tracer().bounds());
  const SurfacePlace place{V3d(2, .1, 0), V3d(0, 0, 1), SurfaceId(0), nullptr, 1};
  const SurfaceChart whole = *SurfaceChart::of(t.scene(), grid, place);
  SurfaceChart strips = whole;
  strips.divideAcross(7);
  EXPECT_NEAR(whole.shorterSide(), 3, 1e-9);
  const int coarse = grid.levelOf(5), fine = grid.levelOf(.1);
  EXPECT_NEAR(strips.stepV(grid, coarse), 3. / 7, 1e-9);
  EXPECT_EQ(strips.stepU(grid, coarse), whole.stepU(grid, coarse));
  EXPECT_EQ(strips.stepU(grid, fine), whole.stepU(grid, fine));
  EXPECT_EQ(strips.stepV(grid, fine), whole.stepV(grid, fine));
  const CellKey first = strips.cellAt(grid, coarse, whole.u(), whole.v()),
                last = strips.cellAt(grid, coarse, whole.u(), whole.v() + 2.8);
  EXPECT_EQ(std::abs(last.j - first.j) + std::abs(last.i - first.i), 6);
  EXPECT_FALSE(first == whole.cellAt(grid, coarse, whole.u(), whole.v()));
  const auto site = strips.site(grid, first);
  ASSERT_TRUE(site);
  EXPECT_LT(site->point.y, 3. / 7);
}

TEST(SurfaceCells, KeysNameCells) {
  const Traced t(kShapes);
  const CellGrid grid(t.prepared().tracer().bounds());
  const auto keyAt = [&](double x, double y, double up, SurfaceId surface = SurfaceId(0)) {
    const auto chart = SurfaceChart::of(
        t.scene(), grid, {V3d(x, y, surface != SurfaceId(0) ? 10 : 0), V3d(0, 0, up), surface, nullptr, 1});
    return chart->cellAt(grid, 4, chart->u(), chart->v());
  };
  EXPECT_EQ(keyAt(.1, .1, 1), keyAt(.2, .15, 1));
  EXPECT_EQ(keyAt(.1, .1, 1).hash(), keyAt(.2, .15, 1).hash());
  EXPECT_FALSE(keyAt(.1, .1, 1) == keyAt(4.9, .1, 1));
  EXPECT_FALSE(keyAt(.1, .1, 1) == keyAt(.1, .1, -1)) << "the other side";
  EXPECT_FALSE(keyAt(.1, .1, 1) == keyAt(.1, .1, 1, SurfaceId(1))) << "another surface";
}

// Surfaces that are too small for separate cells share those of their plane, one set for each side.
TEST(SurfaceCells, PlanesAreSharedByAllThatLiesInThem) {
  const Traced t(kShapes);
  const CellGrid grid(t.prepared().tracer().bounds());
  const V3d normal = V3d(1, 2, 3).normalized(), along = V3d(3, 0, -1), middle(2, 1, 4);
  const auto chartOf = [&](const V3d& point, const V3d& n) {
    return SurfaceChart::ofPlane(grid, {point, n, SurfaceId(0), nullptr, 1});
  };
  const auto keyOf = [&](const SurfaceChart& chart) { return chart.cellAt(grid, 6, .1, .1); };
  const SurfaceChart here = chartOf(middle, normal);
  EXPECT_EQ(keyOf(chartOf(middle + .7 * along, normal)), keyOf(here));
  EXPECT_FALSE(keyOf(chartOf(middle + 4 * grid.lift * normal, normal)) == keyOf(here)) << "beside";
  EXPECT_FALSE(keyOf(chartOf(middle, -normal)) == keyOf(here));
  EXPECT_EQ(here.extent(), HUGE_VAL);
  const auto site = here.site(grid, here.cellAt(grid, 6, here.u(), here.v()));
  ASSERT_TRUE(site);
  EXPECT_NEAR((site->normal - normal).length(), 0, 1e-8);
  const double above = (site->point - middle).dot(normal);
  EXPECT_GT(above, 0);
  EXPECT_LT(above, 3 * grid.lift);
}

}  // namespace
}  // namespace rsphere
