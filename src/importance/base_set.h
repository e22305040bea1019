#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "importance/error_estimate.h"
#include "importance/sphere_options.h"
#include "sphere/direction_bins.h"
#include "sphere/voronoi.h"

namespace rsphere {

// The even directions that every strategy starts from.
struct BaseSet {
  std::vector<V3d> directions;                // unit, world
  std::vector<double> solidAngles;            // solid angles that the directions represent, sr
  std::optional<Neighbours> neighbours;       // if standard errors are wanted
  const SpectralSampling* sampling;           // RayOptions::sampling
  std::shared_ptr<const DirectionBins> zones{};  // zones by which light is divided; null: none
};

// -Sn directions, rotated as -Sr says. Their solid angles are all the same with -Sw h, otherwise those of
// their Voronoi cells. Throws rad::Error if the cells fail the check of -Sv.
BaseSet makeBaseSet(const SphereOptions& options, const SpectralSampling* sampling, bool standardErrors);

// Which directions share a side of their Voronoi cells in the workspace's last query.
Neighbours neighboursOf(const VoronoiWorkspace& workspace);

// Throws rad::Error if the cells of the workspace's last query are wrong (voronoiFault).
void checkCells(const VoronoiWorkspace& workspace);

}  // namespace rsphere
