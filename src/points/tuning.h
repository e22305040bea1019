#pragma once
// Tuning constants (base/tuned.h). They affect the estimated variance, not the mean.
#include "base/tuned.h"

namespace rsphere::tuning {

// The standard error of a mean (error_estimate.cpp).
struct ErrorEstimate {
  // Relative standard error of the mean due to the coarse solution (-aa above 0), assumed independent of the
  // error of the directions. It has two independent parts: kPatches, due to the patches, and kPatches
  // (kUsualRays / n)^1/2, due to rays, for gathers of n rays. Measured in a white room with a lamp, with and
  // without a desk, by -Sn 16384 and patches as for 512 to 8192 rays: .08 to .04%
  // (tests/bench/rtrace/runs/2026-11-28-patches.txt).
  RSPHERE_TUNED(ErrorEstimate, double, kPatches, .0005);
  static constexpr double kUsualRays = 1024;
  // Factor on the variance that is estimated from differences of evenly spread directions: derived. The right
  // value is .6 if all variance is due to straight edges, because evenly spread directions average out part
  // of it, and 1 if all is due to the noise of paths. With the middle of both, stated errors are at most 15%
  // too large and 11% too small. Where directions to one target see a round object as large as ten of their
  // cells, stated errors are up to 35% too large.
  static constexpr double kEvenSet = .8;
  // Smallest number of neighbours for second differences: derived. ownPartOfSecond() does not hold for fewer.
  static constexpr double kFewestAround = 4;
  // Factor like kEvenSet for directions to the parts of a light source: chosen by experiment. Differences
  // between successive parts overestimate the effect of an edge, because it lies between two parts more often
  // than it crosses one. Where all variance is due to one source (half hidden, or with stripes), the stated
  // error is .67 to .88 of the actual one, with 1 .94 to 1.24. Insensitive.
  static constexpr double kEvenParts = .5;
  // The factor like kEvenSet for n dynamic directions to several targets, parts of one image, is 1 / (1 +
  // n^1/2 / kEvenRun). The root is derived: an edge crosses about n^1/2 of the n cells. kEvenRun is chosen
  // by experiment. n is the effective number of directions that cause the variance: with that of all, errors
  // were 1.6 times the stated ones beside a chrome ball, where 1 to 5 of 3400 directions find twice mirrored
  // lamps; with the effective number, .9. Insensitive.
  static constexpr double kEvenRun = 8;
  // Assumed size of an obstacle that no direction has hit, as a fraction of the solid angle that one more
  // direction in a target would represent: derived. If n directions miss an obstacle, the expected fraction
  // that it covers is 1/2 / (n + 1) (Bayes' theorem, with Jeffreys' prior for a probability).
  static constexpr double kUnseen = .5;
  // The stated variance due to light vertices is at least this number of standard deviations of the spread of
  // their batches: chosen by experiment. It is the spread minus the part due to choosing vertices at random,
  // which may be 0 by chance: where a tiny lamp lights a white room (-ab 0), 10% of the answers were off by
  // more than six stated errors without the minimum, and none of 600 with it.
  static constexpr double kLeastShared = .5;
};

// Light in zones (moments.cpp).
struct Moments {
  // If a zone gets a share of a cell, its variance is this factor times share (1 - share) times the squared
  // light of the cell. It is for directions in the middle of their cells; where a direction may be anywhere
  // in its cell, the factor is 1. It is not 0, because the cell is divided approximately, by a few points of
  // a disk. Measured where radiance is even.
  static constexpr double kBorder = .05;
};

}  // namespace rsphere::tuning
