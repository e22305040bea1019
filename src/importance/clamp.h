#pragma once
// The clamp of single directions (-Sf).
#include <span>

#include "base/colorimetry.h"
#include "importance/direction_sample.h"

namespace rsphere {

// Limits the brightness that each sample contributes beyond its guess. The limit is `share` of the integral
// over all directions, without what the same share of the whole integral would take: otherwise one very
// bright direction would raise its own limit. The color of what is left is kept. Contributions below the
// guess are not changed. Returns what the integral lost, which is a bias (W/m2).
//
// total: the integral that the samples belong to, with all that is not among them (W/m2).
//
// Rejected alternatives: a limit of radiance, which is different in each scene; and a share of exactly what
// is left, which takes everything where many directions contribute more than their share.
Irradiance clampContributions(std::span<DirectionSample> samples, const Irradiance& total, double share,
                              const SpectralSampling* sampling);

}  // namespace rsphere
