#include "targets/cells_in_targets.h"

#include <algorithm>
#include <numeric>

#include "base/constants.h"
#include "targets/tuning.h"

namespace rsphere {
namespace {

void fit(std::vector<CellInTarget>& cells, const Targets& targets, std::span<const double> apart) {
  std::vector<double> factors(targets.all().size() + 1);
  for (const CellInTarget& cell : cells)
    if (cell.enters) factors[cell.fitted] += cell.solidAngle;
  factors[0] = 1;
  for (size_t i = 1; i < factors.size(); ++i)
    if (factors[i] > 0)
      factors[i] = std::max(0., targets.all()[i - 1].silhouette.regionSolidAngle() - apart[i]) / factors[i];
  for (CellInTarget& cell : cells) cell.solidAngle *= factors[cell.fitted];
}

void scale(std::vector<CellInTarget>& cells, double total) {
  double inside = 0, outside = 0;
  size_t countOutside = 0;
  for (const CellInTarget& cell : cells) {
    if (!cell.enters) continue;
    (cell.fitted == 0 ? outside : inside) += cell.solidAngle;
    if (cell.fitted == 0) ++countOutside;
  }
  const double left = total - inside;
  const bool byOutside = left > 0 && countOutside >= tuning::Targets::kFewestFitted;
  const double all = inside + outside;
  const double factor = byOutside ? left / outside : all > 0 ? total / all : 0;
  for (CellInTarget& cell : cells)
    if (!byOutside || cell.fitted == 0) cell.solidAngle *= factor;
}

}  // namespace

std::vector<double> cellsInTargets(std::vector<CellInTarget> cells, const Targets& targets,
                                   std::span<const double> apart) {
  fit(cells, targets, apart);
  scale(cells, std::max(0., 4 * kPi - std::accumulate(apart.begin(), apart.end(), 0.)));
  std::vector<double> solidAngles;
  solidAngles.reserve(cells.size());
  for (const CellInTarget& cell : cells) solidAngles.push_back(cell.enters ? cell.solidAngle : 0);
  return solidAngles;
}

}  // namespace rsphere
