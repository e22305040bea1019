#pragma once
// Solid angles of the directions at one point, for -Sw c. Inside a target, the cell of a direction is the
// inverse of the density (1/sr) of all directions there.
#include <cstdint>
#include <span>
#include <vector>

#include "targets/targets.h"

namespace rsphere {

// The cell of one direction.
struct CellInTarget {
  double solidAngle = 0;  // sr
  uint32_t fitted = 0;    // Targets::Region::fitted at the direction
  bool enters = true;     // whether the direction enters the mean
};

// The solid angle (sr) of each direction in the mean, in the order of `cells`; 0 for directions that do not
// enter the mean. apart: solid angle (sr) that directions of its own represent, such as those to the images
// of light sources; index: Targets::Region::fitted. The cells that enter the mean are scaled in two steps:
// - In each fitted target, they are scaled so that with `apart` they add up to its solid angle. This removes
//   the error due to the random number of directions inside the target, and to cells that its edge divides.
// - All are scaled so that with `apart` they add up to the sphere. Only cells outside the fitted targets
//   change, unless there are fewer than tuning::Targets::kFewestFitted of them.
std::vector<double> cellsInTargets(std::vector<CellInTarget> cells, const Targets& targets,
                                   std::span<const double> apart);

}  // namespace rsphere
