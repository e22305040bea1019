#include "points/base_set.h"

#include <numbers>

#include "sphere/directions.h"

namespace rsphere {

BaseSet makeBaseSet(const SphereOptions& options, const SpectralSampling* sampling, bool standardErrors) {
  const auto count = static_cast<size_t>(options.baseDirections);
  BaseSet base{rotatedDirections(baseDirections(count), options.rotation), {}, std::nullopt, sampling};
  base.kernels = {options.bins, standardErrors ? options.quantityErrors : Kernels::Some(), options.facing()};
  if (!options.bins && options.zones > 0)
    base.kernels.zones = std::make_shared<const DirectionBins>(static_cast<size_t>(options.zones));
  const bool equal = options.weights == Weights::homogeneous;
  if (equal) base.solidAngles.assign(count, 4 * std::numbers::pi / static_cast<double>(count));
  if (equal && !standardErrors) return base;
  VoronoiWorkspace workspace;
  const auto areas = cellSolidAngles(base.directions, workspace);
  if (!equal) base.solidAngles.assign(areas.begin(), areas.end());
  if (standardErrors) base.neighbours = neighboursOf(workspace);
  return base;
}

}  // namespace rsphere
