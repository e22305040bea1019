#include "sphere/equal_zones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

using std::numbers::pi;

}  // namespace

EqualZones::EqualZones(size_t count) : first_{0} {
  const auto n = static_cast<double>(count);
  if (count > 1) first_.push_back(1);
  if (count > 2) {
    // The fraction of the sphere within an angle of the pole is the squared sine of half the angle.
    const double cap = 2 * std::asin(std::sqrt(1 / n));
    const double side = std::sqrt(4 * pi / n);  // of a square with the solid angle of a zone
    const double rows = std::max(1., std::round((pi - 2 * cap) / side));
    for (double row = 1; row <= rows; ++row) {
      const double angle = cap + row * (pi - 2 * cap) / rows;
      const double above = n * std::pow(std::sin(angle / 2), 2);
      const auto upTo = row < rows ? static_cast<size_t>(std::lround(above)) : count - 1;
      if (upTo > first_.back()) first_.push_back(upTo);
    }
  }
  first_.push_back(count);
}

double EqualZones::solidAngle() const { return 4 * pi / static_cast<double>(count()); }

std::vector<size_t> EqualZones::rows() const {
  std::vector<size_t> rows;
  for (size_t i = 1; i < first_.size(); ++i) rows.push_back(first_[i] - first_[i - 1]);
  return rows;
}

size_t EqualZones::zoneAt(const V3d& d) const {
  // The number of zones above the direction. Area on the sphere is proportional to height.
  const double above = static_cast<double>(count()) * std::clamp((1 - d.z) / 2, 0., 1.);
  const auto row = std::upper_bound(first_.begin() + 1, first_.end() - 1, above,
                                    [](double x, size_t first) { return x < static_cast<double>(first); });
  const size_t first = *(row - 1), zones = *row - first;
  const double turn = std::atan2(d.y, d.x) / (2 * pi);
  const double along = (turn < 0 ? turn + 1 : turn) * static_cast<double>(zones);
  return first + std::min(static_cast<size_t>(along), zones - 1);
}

V3d EqualZones::middle(size_t zone) const {
  const auto row = std::upper_bound(first_.begin(), first_.end() - 1, zone);
  const size_t first = *(row - 1), zones = *row - first;
  if (count() == 1 || first == 0) return V3d(0, 0, 1);
  if (*row == count()) return V3d(0, 0, -1);
  const double z = 1 - static_cast<double>(first + *row) / static_cast<double>(count());
  const double angle = 2 * pi * (static_cast<double>(zone - first) + .5) / static_cast<double>(zones);
  const double r = std::sqrt(std::max(0., 1 - z * z));
  return V3d(r * std::cos(angle), r * std::sin(angle), z);
}

}  // namespace rsphere
