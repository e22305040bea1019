#include "companions/measure/statistics.h"

#include <numbers>

namespace rsphere {

double beyondT(double t, size_t degrees) {
  t = std::abs(t);
  if (degrees < 1) return 1;
  constexpr size_t kNearlyNormal = 200;
  if (degrees > kNearlyNormal) return std::erfc(t / std::numbers::sqrt2);
  const double angle = std::atan2(t, std::sqrt(static_cast<double>(degrees)));
  const double cosine = std::cos(angle), sine = std::sin(angle);
  double term = degrees % 2 == 1 ? cosine : 1, sum = degrees == 1 ? 0 : term;
  for (size_t k = degrees % 2 == 1 ? 3 : 2; k + 1 < degrees; k += 2) {
    term *= cosine * cosine * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  const double within = degrees % 2 == 1 ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
  return std::max(0., 1 - within);
}

double chanceOf(double difference, double standardError, size_t degrees) {
  if (!(standardError > 0)) return difference == 0 ? 1 : 0;
  return beyondT(difference / standardError, degrees);
}

}  // namespace rsphere
