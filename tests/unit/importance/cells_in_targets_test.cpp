#include "importance/cells_in_targets.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <vector>

#include "importance/base_set.h"
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
  CellsInTargets cells;
  Targets targets;

  explicit Cells(
      std::vector<Target> all, bool (*enters)(const V3d&) = [](const V3d&) { return true; })
      : targets(std::move(all)) {
    for (const V3d& d : directions) {
      cells.add(4 * pi / kDirections, targets.regionAt(d), enters(d));
    }
    cells.fit(targets);
  }

  double sumIn(const Target* target) const {
    double sum = 0;
    for (size_t i = 0; i < directions.size(); ++i)
      if (!target || target->silhouette.contains(directions[i])) sum += cells.solidAngle(i);
    return sum;
  }
};

TEST(CellsInTargets, AddUpToTheSolidAnglesOfTheTargetAndOfTheRest) {
  Cells c({ballAt(V3d(0, 0, 2), .5), ballAt(V3d(3, 0, 0), 1)});
  c.cells.scale(4 * pi);
  for (const Target& target : c.targets.all())
    EXPECT_NEAR(c.sumIn(&target), target.silhouette.solidAngle(), 1e-12);
  EXPECT_NEAR(c.sumIn(nullptr), 4 * pi, 1e-12);
}

TEST(CellsInTargets, StayWhereATargetIsNotToBeFitted) {
  Cells c({ballAt(V3d(0, 0, 2), .5, false)});
  for (size_t i = 0; i < c.directions.size(); ++i) EXPECT_EQ(c.cells.solidAngle(i), 4 * pi / kDirections);
}

// Half of a target shows a light source that is integrated separately: its directions are left out after the
// fit.
TEST(CellsInTargets, LeaveOutWhatDoesNotEnterTheMean) {
  Cells c({ballAt(V3d(0, 0, 2), 1)}, [](const V3d& d) { return d.z < .7 || d.x > 0; });
  const double half = c.targets.all()[0].silhouette.solidAngle() / 2;
  c.cells.scale(4 * pi - half);
  EXPECT_NEAR(c.sumIn(&c.targets.all()[0]), half, .1 * half);
  EXPECT_NEAR(c.sumIn(nullptr), 4 * pi - half, 1e-12);
}

// Within a ball of glass, all directions are in the target.
TEST(CellsInTargets, AreAllScaledWhereTargetsFillTheSphere) {
  Cells c({ballAt(V3d(0, 0, 0), 1)});
  c.cells.scale(3 * pi);
  EXPECT_NEAR(c.sumIn(nullptr), 3 * pi, 1e-12);
}

}  // namespace
}  // namespace rsphere
