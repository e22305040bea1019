#include "importance/direction_guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importance/tuning.h"
#include "scene/even_sequence.h"

namespace rsphere {
namespace {

using std::numbers::pi;

// Cells of equal area: rows of equal height along z, divided evenly about it. A cell of 32 x 64 is 4.5
// degrees wide.
constexpr size_t kRows = 32, kColumns = 64, kCells = kRows * kColumns;
constexpr double kCell = 4 * pi / kCells;  // sr

using Tuning = tuning::DirectionGuide;

}  // namespace

size_t DirectionGuide::cellOf(const V3d& direction) {
  const auto row = static_cast<size_t>(std::clamp((direction.z + 1) / 2 * kRows, 0., kRows - 1.));
  const double turn = std::atan2(direction.y, direction.x) / (2 * pi);
  const auto column =
      static_cast<size_t>(std::clamp((turn - std::floor(turn)) * kColumns, 0., kColumns - 1.));
  return row * kColumns + column;
}

DirectionGuide::DirectionGuide(const LightPatches& light, const Tracer& tracer, const V3d& point) {
  const auto& patches = light.all();
  std::vector<double> upTo;
  double all = 0;
  for (const LightPatches::Patch& patch : patches) {
    const V3d to = patch.point - point;
    const double distance2 = to.length2(), facing = -to.dot(patch.normal);
    if (facing > 0) all += patch.power * facing / (std::sqrt(distance2) * (distance2 + light.area()));
    upTo.push_back(all);
  }
  // Some of the patches, in proportion to the light that arrives from them if nothing is in the way; those
  // that are hidden are left out.
  std::vector<size_t> seen(kCells, 0);
  size_t count = 0;
  const double step = all / Tuning::kPatches;
  double due = step / 2;
  for (size_t i = 0; i < patches.size(); ++i) {
    if (due >= upTo[i]) continue;
    const V3d to = patches[i].point - point;
    const double distance = to.length();
    const bool visible = tracer.shadow(point, to / distance, distance * (1 - 1e-6), kNone) != Shadow::blocked;
    for (; due < upTo[i]; due += step)
      if (visible) {
        ++seen[cellOf(to / distance)];
        ++count;
      }
  }
  if (count == 0) return;
  // The light of a cell is spread over its neighbours, because patches are few, and larger than a cell if
  // near.
  share_.assign(kCells, 0);
  for (size_t row = 0; row < kRows; ++row)
    for (size_t column = 0; column < kColumns; ++column) {
      const double w = static_cast<double>(seen[row * kColumns + column]) / static_cast<double>(count);
      if (!(w > 0)) continue;
      for (size_t i = 0; i < 9; ++i) {
        const size_t r = std::clamp<size_t>(row + i / 3, 1, kRows) - 1,
                     c = (column + i % 3 + kColumns - 1) % kColumns;
        share_[r * kColumns + c] += w / 9;
      }
    }
}

double DirectionGuide::density(const V3d& direction) const {
  return share_.empty() ? 0 : share_[cellOf(direction)] / kCell;
}

std::vector<V3d> DirectionGuide::directions(size_t count, Random& random) const {
  std::vector<V3d> drawn;
  if (share_.empty()) return drawn;
  drawn.reserve(count + 1);
  const double shift1 = random.uniform(), shift2 = random.uniform();
  double due = random.uniform();
  for (size_t row = 0; row < kRows; ++row)
    for (size_t k = 0; k < kColumns; ++k) {
      // Back and forth, so that successive cells are neighbours.
      const size_t column = row % 2 ? kColumns - 1 - k : k;
      due += share_[row * kColumns + column] * static_cast<double>(count);
      for (; due >= 1; --due) {
        const Imath::V2d u = evenly(drawn.size(), shift1, shift2);
        const double z = 2 * (static_cast<double>(row) + u.x) / kRows - 1;
        const double r = std::sqrt(std::max(0., 1 - z * z));
        const double angle = 2 * pi * (static_cast<double>(column) + u.y) / kColumns;
        drawn.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    }
  return drawn;
}

}  // namespace rsphere
