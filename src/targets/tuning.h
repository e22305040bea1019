#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// The contrast of special objects with their surroundings (contrasts.cpp), measured once per scene.
struct Contrasts {
  // Rays to the special objects of one modifier; twice as many paths sample the typical view. Chosen by
  // experiment. For normally distributed values, the standard deviation is then known within 9%, 1/sqrt(2 x
  // 63). To limit the time at start, all modifiers together get kRaysToAll, but each at least 2: with
  // separate rays for each object, the start took 1.1 s instead of .05 s. Insensitive.
  RSPHERE_DERIVED(Contrasts, size_t, kRays, 64);
  static constexpr size_t kRaysToAll = 1024;
  // Points in one region share measurements. The region is the widest one around a point from which at most
  // this many times as many objects can be seen as from the point. With 1, 4 and 16, four means in a tower
  // take equal times within noise; with 1, more than four points would share fewer measurements.
  static constexpr size_t kWider = 2;
};

// The regions that get extra directions (targets.cpp).
struct Targets {
  // An image of a light source in a ball becomes a target if it would otherwise add more than this fraction
  // of the variance of all base directions: chosen by experiment. Insensitive.
  RSPHERE_DERIVED(Targets, double, kLeastGlint, 1e-3);
  // Standard deviation of the brightness within a partly lit region, relative to the brightness of its lit
  // part: derived. .5 is the largest possible value, and holds if half of the region is lit. Measurements for
  // the three kinds of regions confirm it:
  // - Images of light sources in balls. Reducing it by 30% changes the error by +12%, raising it by 30% by
  //   -20% (points beside chrome).
  // - Openings that show daylight, in a room with a window onto a house below an uneven sky. Errors of 512
  //   directions; the times are equal within noise:
  //   value                            no targets   0      .1     .25    .5
  //   error with two bounces           6.9%         3.8%   2.9%   2.7%   2.5%
  //   error with none                  76%          51%    5.9%   3.8%   2.3%
  // - Spots of daylight. With the default number of directions, the errors in two sunlit rooms are 1.5 and
  //   1.8% with such targets, 2.75 and 1.9% without. With .25 or 1, no effect beyond noise.
  RSPHERE_DERIVED(Targets, double, kPartlyLit, .5);
  // An opening gets at least Caps::kProbes directions if it would, unoccluded, give more than this
  // fraction of the light at a point, and n^1/2 times as many if n times this fraction: chosen by
  // experiment. With Caps::kProbes at most, and fewer where mirrors take most directions, a point below a
  // skylight by a mirror has 5.2 instead of 2.3% of noise
  // (tests/bench/rtrace/runs/2026-11-29-portals.txt). With .1, a far window that happens to be dark in
  // the rays around a point causes errors of up to 10% instead of 5%. With only 8 directions, an opening
  // with an eighth hidden often looks unobstructed. Without the minimum, variance x time is 1.46 times as
  // large in a room with a small window (-aa .1), and 1.0 to 1.1 times in five other rooms
  // (tests/bench/mechanisms/runs/2026-11-29-tails.txt).
  RSPHERE_TUNED(Targets, double, kLeastOpening, .01);
  // Cells in a target are fitted to its solid angle if at least this many directions are expected in it:
  // chosen by experiment. Fitting biases the mean if the number of directions is correlated with the radiance
  // that they find. With 8 no bias is found: .02 +- .02% (128 base directions). With 4 or 16, the errors in
  // rooms with a window do not change.
  RSPHERE_TUNED(Targets, double, kFewestFitted, 8);
};

}  // namespace rsphere::tuning
