#include "targets/cells_in_targets.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <vector>

#include "points/base_set.h"
#include "sphere/directions.h"

namespace rsphere {
namespace {

using std::numbers::pi;

constexpr size_t kDirections = 1000;

Target ballAt(const V3d& center, double radius, bool fitted = true) {
  return {silhouetteOf(Shape(Sphere{center, radius}), {}, V3d(0, 0, 0)), 0, 0, false, fitted, fitted};
}

// Even directions with cells that are all the same, of which those that enters(direction) is true of enter
// the mean.
struct Cells {
  std::vector<V3d> directions = baseDirections(kDirections);
  Targets targets;
  std::vector<double> solidAngles;

  explicit Cells(
      std::vector<Target> all, std::vector<double> apart,
      bool (*enters)(const V3d&) = [](const V3d&) { return true; })
      : targets(std::move(all)) {
    std::vector<CellInTarget> cells;
    for (const V3d& d : directions)
      cells.push_back({4 * pi / kDirections, targets.regionAt(d).fitted, enters(d)});
    solidAngles = cellsInTargets(std::move(cells), targets, apart);
  }

  double sumIn(const Target* target) const {
    double sum = 0;
    for (size_t i = 0; i < directions.size(); ++i)
      if (!target || target->silhouette.contains(directions[i])) sum += solidAngles[i];
    return sum;
  }
};

TEST(CellsInTargets, AddUpToTheSolidAnglesOfTheTargetAndOfTheRest) {
  const Cells c({ballAt(V3d(0, 0, 2), .5), ballAt(V3d(3, 0, 0), 1)}, {0, 0, 0});
  for (const Target& target : c.targets.all())
    EXPECT_NEAR(c.sumIn(&target), target.silhouette.solidAngle(), 1e-12);
  EXPECT_NEAR(c.sumIn(nullptr), 4 * pi, 1e-12);
}

TEST(CellsInTargets, StayWhereATargetIsNotToBeFitted) {
  const Cells c({ballAt(V3d(0, 0, 2), .5, false)}, {0, 0});
  for (const double solidAngle : c.solidAngles) EXPECT_NEAR(solidAngle, 4 * pi / kDirections, 1e-15);
}

// Half of a target shows a light source that is integrated separately. However many directions show it, the
// others represent the rest.
TEST(CellsInTargets, LeaveOutWhatDoesNotEnterTheMean) {
  const double half = ballAt(V3d(0, 0, 2), 1).silhouette.solidAngle() / 2;
  const Cells c({ballAt(V3d(0, 0, 2), 1)}, {0, half}, [](const V3d& d) { return d.z < .7 || d.x > .1; });
  EXPECT_NEAR(c.sumIn(&c.targets.all()[0]), half, 1e-12);
  EXPECT_NEAR(c.sumIn(nullptr), 4 * pi - half, 1e-12);
}

// Within a ball of glass, all directions are in the target.
TEST(CellsInTargets, AreAllScaledWhereTargetsFillTheSphere) {
  const Cells c({ballAt(V3d(0, 0, 0), 1)}, {0, pi});
  EXPECT_NEAR(c.sumIn(nullptr), 3 * pi, 1e-12);
}

}  // namespace
}  // namespace rsphere
