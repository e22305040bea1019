#include "sphere/direction_bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

constexpr size_t kFineZones = size_t{1} << 20;

}  // namespace

DirectionBins::DirectionBins(size_t count, const std::function<size_t(const V3d&)>& binOf)
    : zones_(kFineZones), binOf_(kFineZones), count_(count), solidAngles_(count, 0) {
  for (size_t zone = 0; zone < kFineZones; ++zone) {
    const size_t bin = std::min(binOf(zones_.middle(zone)), count);
    binOf_[zone] = static_cast<uint32_t>(bin);
    if (bin < count) solidAngles_[bin] += zones_.solidAngle();
  }
}

void DirectionBins::placePoints(const V3d& direction, double solidAngle, std::array<V3d, kPoints>& points) {
  using std::numbers::pi;
  // At this distance from the middle, the mean square distance of all points is that of the disk, r2 / 2.
  const double distance = std::sqrt(solidAngle / pi * kPoints / (2. * (kPoints - 1)));
  const V3d aside = std::abs(direction.z) < .9 ? V3d(0, 0, 1) : V3d(1, 0, 0);
  const V3d x = direction.cross(aside).normalized(), y = direction.cross(x);
  points[0] = direction;
  for (size_t i = 1; i < kPoints; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / (kPoints - 1);
    points[i] = (direction + distance * (std::cos(angle) * x + std::sin(angle) * y)).normalized();
  }
}

}  // namespace rsphere
