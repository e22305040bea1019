#include "glare/glare_indices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rsphere {

SeenGlare& SeenGlare::operator+=(const SeenGlare& other) {
  solidAngle += other.solidAngle;
  light += other.light;
  illuminance += other.illuminance;
  towards += other.towards;
  return *this;
}

SeenGlare SeenGlare::operator*(double factor) const {
  return {solidAngle * factor, light * factor, illuminance * factor, towards * factor};
}

double SeenGlare::weight(const Gaze& gaze) const {
  if (!(light > 0) || !(solidAngle > 0)) return 0;
  const double p = positionIndex(gaze);
  return light * luminance() / (p * p);
}

double unifiedGlareRating(double background, double sum) {
  if (!(sum > 0)) return 0;
  if (!(background > 0)) return std::numeric_limits<double>::infinity();
  return 8 * std::log10(.25 / background * sum);
}

double daylightGlareProbability(double illuminance, double sum) {
  constexpr double kLeast = .16;
  if (!(illuminance > 0)) return kLeast;
  return std::min(1.,
                  5.87e-5 * illuminance + .0918 * std::log10(1 + sum / std::pow(illuminance, 1.87)) + kLeast);
}

GlareIndices glareIndices(double illuminance, std::span<const SeenGlare> sources, const Gaze& gaze) {
  double sum = 0, direct = 0;
  for (const SeenGlare& source : sources) {
    sum += source.weight(gaze);
    direct += source.illuminance;
  }
  GlareIndices indices;
  indices.illuminance = illuminance;
  indices.background = std::max(0., (illuminance - direct) / std::numbers::pi);
  indices.ugr = unifiedGlareRating(indices.background, sum);
  indices.dgp = daylightGlareProbability(illuminance, sum);
  return indices;
}

}  // namespace rsphere
