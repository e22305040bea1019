#include "points/clamp.h"

#include <algorithm>

namespace rsphere {

Irradiance clampContributions(std::span<DirectionSample> samples, const Irradiance& total, double share,
                              const SpectralSampling* sampling) {
  const auto followed = [&](const DirectionSample& s) {
    return photopicOf(irradianceFrom(s.value - s.glanced, s.solidAngle).color, sampling);
  };
  const double all = photopicOf(total.color, sampling);
  double excess = 0;
  for (const DirectionSample& s : samples) excess += std::max(0., followed(s) - share * all);
  const double limit = share * (all - excess);
  Irradiance taken;
  if (!(limit > 0)) return taken;
  for (DirectionSample& s : samples) {
    const double contribution = followed(s);
    if (contribution <= limit) continue;
    const Radiance before = s.value;
    s.value = s.glanced + (before - s.glanced) * (limit / contribution);
    taken += irradianceFrom(before - s.value, s.solidAngle);
  }
  return taken;
}

}  // namespace rsphere
