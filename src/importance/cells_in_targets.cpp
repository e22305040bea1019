#include "importance/cells_in_targets.h"

#include <algorithm>
#include <cmath>

#include "importance/tuning.h"

namespace rsphere {

using Tuning = tuning::CellsInTargets;

void CellsInTargets::add(double cell, bool enters) {
  cells_.push_back(cell);
  enters_.push_back(enters);
  fitted_.push_back(false);
  ends_.push_back(targets_.size());
}

void CellsInTargets::fit(const Targets& targets) {
  const std::span<const Target> all = targets.all();
  std::vector<std::vector<uint32_t>> directions(all.size());  // by target
  for (uint32_t i = 0, k = 0; i < cells_.size(); ++i)
    for (; k < ends_[i]; ++k) {
      directions[targets_[k]].push_back(i);
      fitted_[i] = true;
    }
  for (int pass = 0; pass < Tuning::kMostPasses; ++pass) {
    double farthest = 0;
    for (size_t t = 0; t < all.size(); ++t) {
      double sum = 0;
      for (const uint32_t i : directions[t]) sum += cells_[i];
      if (!(sum > 0)) continue;
      const double factor = all[t].silhouette.regionSolidAngle() / sum;
      for (const uint32_t i : directions[t]) cells_[i] *= factor;
      farthest = std::max(farthest, std::abs(factor - 1));
    }
    if (farthest < Tuning::kSettled) break;
  }
}

void CellsInTargets::scale(double solidAngle) {
  double inside = 0, outside = 0;
  for (size_t i = 0; i < cells_.size(); ++i)
    if (enters_[i]) (fitted_[i] ? inside : outside) += cells_[i];
  const double left = solidAngle - inside;
  const bool byOutside = left > 0 && std::abs(left - outside) < Tuning::kMostScaled * outside;
  const double all = inside + outside;
  const double factor = byOutside ? left / outside : all > 0 ? solidAngle / all : 0;
  for (size_t i = 0; i < cells_.size(); ++i)
    if (!byOutside || !fitted_[i]) cells_[i] *= factor;
}

}  // namespace rsphere
