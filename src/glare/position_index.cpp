#include "glare/position_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kLargest = 16;

// sigma, tau: degrees.
double aboveSight(double sigma, double tau) {
  return (35.2 - .31889 * tau - 1.22 * std::exp(-2 * tau / 9)) * sigma / 1e3 +
         (21 + .26667 * tau - .002963 * tau * tau) * sigma * sigma / 1e5;
}

double belowSight(double beta) { return 6.49 * beta / 1e3 + 21 * beta * beta / 1e5; }

}  // namespace

std::optional<Gaze> Gaze::upright(const V3d& direction) {
  constexpr double kVertical = 1e-6;  // rad
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
  const V3d ahead = (direction / largest).normalized();
  if (std::hypot(ahead.x, ahead.y) < kVertical) return std::nullopt;
  return Gaze{ahead, (V3d(0, 0, 1) - ahead * ahead.z).normalized()};
}

double positionIndex(const V3d& direction, const Gaze& gaze) {
  const V3d right = gaze.direction.cross(gaze.up);
  const double ahead = gaze.direction.dot(direction), above = gaze.up.dot(direction);
  const double aside = std::abs(right.dot(direction)), off = std::hypot(above, aside);
  const double tau = std::atan2(aside, above);
  double exponent;
  if (above >= 0) {
    exponent = aboveSight(kDegrees * std::atan2(off, ahead), kDegrees * tau);
  } else {
    const double stretched = off * std::sqrt(1 + .3225 * std::pow(std::cos(tau), 2));
    exponent = belowSight(kDegrees * std::atan2(stretched, ahead));
  }
  return std::min(kLargest, std::exp(exponent));
}

}  // namespace rsphere
