#pragma once
// The solid angles of the cells of one point's directions, as -Sw c has them: a direction in a target
// represents the inverse of the density of all directions there.
#include <cstdint>
#include <vector>

#include "importance/targets.h"

namespace rsphere {

class CellsInTargets {
 public:
  // Adds the cell (sr) of a direction. region: of the direction. enters: whether it enters the mean.
  void add(double cell, const Targets::Region& region, bool enters);

  // Scales the cells in each target that is to be fitted, so that they add up to its solid angle. How many
  // directions happen to lie in a target, and which cells its edge divides, then is no error anymore.
  void fit(const Targets& targets);

  // Scales the cells that enter the mean, so that they add up to solidAngle (sr). If that can be met by those
  // outside the targets that were fitted, the others keep their size.
  void scale(double solidAngle);

  // Of the direction that was added as number i, sr. 0 if it does not enter the mean.
  double solidAngle(size_t i) const { return cells_[i].enters ? cells_[i].solidAngle : 0; }

 private:
  struct Cell {
    double solidAngle;  // sr
    uint32_t target;    // Targets::Region::fitted
    bool enters;
  };
  std::vector<Cell> cells_;
};

}  // namespace rsphere
