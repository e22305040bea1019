#pragma once
// The solid angles of the cells of one point's directions, for -Sw c: in a target, each direction represents
// the inverse of the density of all directions there.
#include <cstdint>
#include <span>
#include <vector>

#include "importance/targets.h"

namespace rsphere {

// The cell of one direction.
struct CellInTarget {
  double solidAngle = 0;  // sr
  uint32_t fitted = 0;    // Targets::Region::fitted, of the direction
  bool enters = true;     // whether the direction enters the mean
};

// The solid angles (sr) with which the directions enter the mean, in the same order; 0 for those that do not
// enter it. Two steps scale the cells:
// - In each target that is to be fitted, they add up to its solid angle. This removes the error due to the
//   random number of directions inside the target, and to cells that its edge divides.
// - All cells that enter the mean add up to `total` (sr). Only those outside the fitted targets are scaled,
//   unless they would have to change too much.
std::vector<double> cellsInTargets(std::vector<CellInTarget> cells, const Targets& targets, double total);

}  // namespace rsphere
