#include "companions/trade/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace rsphere {
namespace {

constexpr double kMinute = 60;
// With fewer degrees of freedom, the estimated error is usually wrong by more than a third.
constexpr double kLeastDegrees = 4;

double rotationsNeeded(const ReferenceProgress& p) {
  const auto least = static_cast<double>(p.leastRotations);
  if (!canPredict(p) || p.target <= 0) return least;
  return std::max(least, p.rotations * std::pow(p.error / p.target, 2));
}

double secondsOfOne(const ReferenceProgress& p) { return p.seconds / p.rotations; }

// Rounded up to two digits, so that the error can be reached.
double roundedUp(double x) {
  const double unit = std::pow(10., std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit - 1e-9) * unit;
}

}  // namespace

bool canPredict(const ReferenceProgress& p) {
  return p.rotations > 1 && (p.rotations - 1) * static_cast<double>(p.points) >= kLeastDegrees;
}

double secondsLeft(const ReferenceProgress& p) {
  return std::max(0., rotationsNeeded(p) - p.rotations) * secondsOfOne(p);
}

std::string slowReference(const ReferenceProgress& p) {
  const double whole = rotationsNeeded(p) * secondsOfOne(p);
  if (whole <= kMinute) return {};
  const double least = static_cast<double>(p.leastRotations) * secondsOfOne(p);
  const double soon = std::max(kMinute, least);
  const double fewer = static_cast<double>(p.points) * kMinute / (least > kMinute ? least : whole);
  std::vector<std::string> quicker;
  std::string text = "the reference takes ";
  if (canPredict(p)) {
    text += fmt::format("about {} (error {:.2g}% after {} rotations, {:.2g}% wanted)", durationText(whole),
                        100 * p.error, p.rotations, 100 * p.target);
    if (whole > soon)
      quicker.push_back(fmt::format("-Te {:.2g} ends it after {}",
                                    roundedUp(p.error * std::sqrt(p.seconds / soon)), durationText(soon)));
  } else {
    text += fmt::format("at least {} for its {} rotations", durationText(least), p.leastRotations);
  }
  quicker.push_back(
      fmt::format("-Tm {} measures fewer points", std::max<size_t>(static_cast<size_t>(fewer), 1)));
  if (p.moreThreads) quicker.emplace_back("-n 0 uses all cores");
  return fmt::format("{}: {}", text, fmt::join(quicker, ", "));
}

double costOf(const AnswerOptions& setting) {
  const RayOptions& ray = setting.ray;
  const double rays = ray.ambientBounces > 0 ? std::max(1, ray.ambientDivisions) : 1;
  return setting.sphere.baseDirections * std::pow(rays, .75);
}

double secondsLeft(std::span<const double> costs, size_t done, double seconds) {
  const auto middle = costs.begin() + static_cast<ptrdiff_t>(done);
  const double before = std::accumulate(costs.begin(), middle, 0.);
  return before > 0 ? seconds * std::accumulate(middle, costs.end(), 0.) / before : 0;
}

std::string durationText(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 10 * kMinute) return fmt::format("{:.1f} min", seconds / kMinute);
  if (seconds < 100 * kMinute) return fmt::format("{:.0f} min", seconds / kMinute);
  return fmt::format("{:.1f} h", seconds / (60 * kMinute));
}

}  // namespace rsphere
