#pragma once
// The clamp of single directions (-Sf).
#include <span>

#include "base/colorimetry.h"
#include "points/direction_sample.h"

namespace rsphere {

// Clamps the brightness that each sample adds to the light found by glances to `share` times an integral
// over all directions. That integral is itself clamped, by `share` times the whole integral: otherwise one
// very bright direction would raise its own limit. Colors stay the same, and so does light found by glances.
// Returns the loss of the integral, which is a bias (W/m2).
//
// total: the whole integral, including light that is not among the samples (W/m2).
//
// Rejected alternatives: a limit of radiance, because it would depend on the scene; and a share of the
// integral that remains after clamping with this very limit, because where many directions contribute more
// than their share, no light would remain.
Irradiance clampContributions(std::span<DirectionSample> samples, const Irradiance& total, double share,
                              const SpectralSampling* sampling);

}  // namespace rsphere
