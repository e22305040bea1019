#pragma once
// The clamp of single directions (-Sf).
#include <span>

#include "base/colorimetry.h"
#include "importance/direction_sample.h"

namespace rsphere {

// Limits the brightness that each sample contributes beyond its guess. The limit is `share` times an integral
// over all directions that is itself clamped, by a limit of `share` times the whole integral: otherwise one
// very bright direction would raise its own limit. The color of the remainder does not change. Contributions
// below the guess are not changed. Returns what the integral lost, which is a bias (W/m2).
//
// total: the whole integral, including light that is not among the samples (W/m2).
//
// Rejected alternatives: a limit of radiance, which is different in each scene; and a share of the integral
// after clamping with that same limit, which removes everything where many directions contribute more than
// their share.
Irradiance clampContributions(std::span<DirectionSample> samples, const Irradiance& total, double share,
                              const SpectralSampling* sampling);

}  // namespace rsphere
