#include "importance/cells_in_targets.h"

#include <cmath>

#include "importance/tuning.h"

namespace rsphere {

using Tuning = tuning::CellsInTargets;

void CellsInTargets::add(double cell, const Targets::Region& region, bool enters) {
  cells_.push_back({cell, region.fitted, enters});
}

void CellsInTargets::fit(const Targets& targets) {
  std::vector<double> factors(targets.all().size() + 1);
  for (const Cell& cell : cells_) factors[cell.target] += cell.solidAngle;
  factors[0] = 1;
  for (size_t i = 1; i < factors.size(); ++i)
    if (factors[i] > 0) factors[i] = targets.all()[i - 1].silhouette.regionSolidAngle() / factors[i];
  for (Cell& cell : cells_) cell.solidAngle *= factors[cell.target];
}

void CellsInTargets::scale(double solidAngle) {
  double inside = 0, outside = 0;
  for (const Cell& cell : cells_)
    if (cell.enters) (cell.target == 0 ? outside : inside) += cell.solidAngle;
  const double left = solidAngle - inside;
  const bool byOutside = left > 0 && std::abs(left - outside) < Tuning::kMostScaled * outside;
  const double all = inside + outside;
  const double factor = byOutside ? left / outside : all > 0 ? solidAngle / all : 0;
  for (Cell& cell : cells_)
    if (!byOutside || cell.target == 0) cell.solidAngle *= factor;
}

}  // namespace rsphere
