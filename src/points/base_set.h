#pragma once
#include <optional>
#include <vector>

#include "points/error_estimate.h"
#include "points/kernels.h"
#include "points/sphere_options.h"
#include "sphere/direction_bins.h"
#include "sphere/voronoi.h"

namespace rsphere {

// Evenly spread directions, shared by all points. Every strategy (-Sw) uses them.
struct BaseSet {
  std::vector<V3d> directions;           // unit, world
  std::vector<double> solidAngles;       // solid angles that the directions represent, sr
  std::optional<Neighbours> neighbours;  // empty unless standard errors are requested
  const SpectralSampling* sampling;      // the run's: RayOptions::sampling
  Kernels kernels{};                     // zones, and the quantities that have standard errors
};

// Makes -Sn directions, rotated by -Sr. With -Sw h their solid angles are equal, otherwise those of their
// Voronoi cells.
BaseSet makeBaseSet(const SphereOptions& options, const SpectralSampling* sampling, bool standardErrors);

// The pairs of directions whose Voronoi cells share a side, in the last query of the workspace.
inline Neighbours neighboursOf(const VoronoiWorkspace& workspace) {
  VoronoiCells cells = voronoiCells(workspace);
  return {std::move(cells.first), std::move(cells.neighbour)};
}

}  // namespace rsphere
