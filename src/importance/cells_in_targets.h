#pragma once
// The solid angles of the cells of one point's directions, as -Sw c has them: a direction in a target represents
// the inverse of the density of all directions there.
#include <cstdint>
#include <vector>

#include "importance/targets.h"

namespace rsphere {

class CellsInTargets {
 public:
  // As Targets::regionAt(). Remembers the targets that the next cell lies in.
  Targets::Region regionAt(const V3d& direction, const Targets& targets) {
    return targets.regionAt(direction, targets_);
  }
  // Adds the cell (sr) of the direction that regionAt() was asked about. enters: whether the direction enters the
  // mean.
  void add(double cell, bool enters);

  // Scales the cells in each target that is to be fitted, so that they add up to its solid angle. How many directions
  // happen to lie in a target, and which cells its edge divides, then is no error anymore. Where targets overlap, all
  // solid angles are met together by iterative proportional fitting (Deming and Stephan 1940, Annals of Mathematical
  // Statistics 11/4).
  void fit(const Targets& targets);

  // Scales the cells that enter the mean, so that they add up to solidAngle (sr). If that can be met by those
  // outside the targets that were fitted, the others keep their size.
  void scale(double solidAngle);

  // Of the direction that was added as number i, sr. 0 if it does not enter the mean.
  double solidAngle(size_t i) const { return enters_[i] ? cells_[i] : 0; }

 private:
  std::vector<double> cells_;  // sr
  std::vector<bool> enters_, fitted_;
  std::vector<uint32_t> targets_;  // that contain each direction, of all directions in turn
  std::vector<size_t> ends_;       // in targets_, for each direction
};

}  // namespace rsphere
