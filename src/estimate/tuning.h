#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, and Stopping slightly affects the mean.
#include <cstddef>

namespace rsphere::tuning {

// The strategy -Sw c as a whole (silhouette_weights.cpp).
struct SilhouetteWeights {
  // Base directions for each direction to images of light sources; the latter are at least
  // SeenSources::kUsualRays. Chosen by experiment. Insensitive.
  static constexpr size_t kBaseDirectionsPerRayToImages = 4;
};

// The end of -Sa (two_halves.cpp).
struct Stopping {
  // Each half requests sets until its standard error is below this multiple of the requested one: measured.
  // One answer in 50, instead of 25, then needs further sets because its own error estimate is too large.
  // Those sets cause the remaining bias. Insensitive.
  static constexpr double kMargin = .95;
  // Cap on the ratio between the numbers of sets of the two halves: derived. If a set finds something very
  // bright, the other half requests many sets. With the cap, the half of the bright set gets more sets, too,
  // which reduces the weight of the bright one sooner. With a ratio of 1, the number of sets of a half would
  // depend on its own sets: the bias that the halves avoid. 2 is the next integer.
  static constexpr size_t kMostRatio = 2;
};

// The sets of a ray (ray_estimator.cpp). Measured: tests/bench/rtrace/runs/2026-11-28-ray-errors.txt.
struct RaySets {
  // Rays of a set's gather in the first round of -Sa.
  static constexpr int kFirst = 32;
  // Cap on the rays of one gather. Further rays are sent in further gathers, which draw the shadow rays of
  // the first surface and the samples of its lobes anew.
  static constexpr int kMostAtOnce = 1024;
  // Gathers that each set gets in the first round: 16 in all. With one, six degrees of freedom state the
  // error of a first round, and answers stop where it is stated a quarter too small. Later rounds have one
  // each, because large gathers are stratified more finely.
  static constexpr int kFirstGathers = 2;
  // Each round multiplies the number of rays by at most kGrowth, and at least kLeastGrowth if at all.
  // Measured: with 3, 512 rays at once and two gathers in each round, sensors take 1.05 to 1.35 times the
  // time by daylight for equal errors, and as long by lamps (2026-11-30-rounds.txt).
  static constexpr double kGrowth = 6, kLeastGrowth = 1.15;
  // With patches: the error of gathers that halves request, relative to the accuracy. The rest is for the
  // noise of patches, of which eight solutions tell too little to decide on rays. Measured: true/stated by
  // lamps is 1.16 with .7, and 1.09 with .76 (2026-11-30-sensors.txt).
  static constexpr double kOfGathers = .75;
  // -Sa: if the error is too large in the end, there are at least kAtLast times as many rays, unless the
  // variance of gathers is below kLargePart of the accuracy's square: more rays would hardly help. Chosen.
  static constexpr double kAtLast = 1.5, kLargePart = .3;
  // -Sa: patches are too noisy if the error that the spread of their solutions shows is above kTooNoisy times
  // the accuracy: measured. With 1, a museum with spots takes 2.4 times the time for .9 times the error; with
  // 1.5, 1.6 times (2026-11-29-tails.txt). Its square is also above kByPatches times the variance of the
  // gathers: chosen. When the noise of gathers is larger, eight solutions exceed it by chance less than once
  // in 10,000 times. Where rays no longer help, paths are tried above kByPatchesAtLast times that variance,
  // which solutions without noise exceed once in 20 times. Measured: without that, sensors in a light well
  // without glass have errors of 13% instead of 5%, stated as 6% (2026-11-30-rounds.txt).
  static constexpr double kTooNoisy = 1.5, kByPatches = 5, kByPatchesAtLast = 2;
  // Rays whose value is below this fraction of the average radiance in view of the scene's surfaces are
  // answered as if their value were as large. In daylit models that average is mostly that of the ground
  // outside, a hundred times brighter than a room.
  static constexpr double kDark = 1e-4;
  // Limits on the rays of patches relative to -ad + -as.
  static constexpr double kFewestForPatches = .25, kMostForPatches = 100;
  // Cap on the rays of all sets, times the square of -Sa.
  static constexpr double kMost = 6.5;
};

// Points at which almost no light arrives (estimator.cpp, two_halves.cpp).
struct Dark {
  // -Sa stops early if the mean is below this fraction of the average radiance on the scene's surfaces. A
  // warning names the point if less than this fraction of the directions find light. Derived: it is two of
  // the usual 2048 directions, whose mean is known within 71%. In closed metal furniture, one direction in a
  // hundred thousand finds a gap between surfaces; a million directions could not measure its light within a
  // percent. Insensitive.
  static constexpr double kShare = 2. / 2048;
};

// Glare at an eye (glare_estimator.cpp).
struct Glare {
  // Number of rays to the task. Its luminance is then known within 6% if single values vary as much as their
  // mean.
  static constexpr size_t kTaskRays = 256;
};

}  // namespace rsphere::tuning
