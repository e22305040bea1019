#pragma once
// The tuning constants of this folder (base/tuned.h). They affect the variance of direct light and the
// computing time, but not the mean.
//
// Each comment gives the meaning and the unit, and after the colon the origin of the value. Its last sentence
// gives the effect on error and time of a value that is 30% smaller or larger, in the case of
// tests/bench/sensitivity where the effect is largest (runs/2026-11-22.txt there).
#include "base/tuned.h"

namespace rsphere::tuning {

// How light sources are divided into parts and sampled (sources.cpp).
struct SourceParts {
  // A part of a plane source is sampled by solid angle instead of by area if its width is larger than this,
  // relative to its distance: chosen by experiment. Over a narrower part, cosine / distance^2 varies little,
  // so that its middle is used for guesses of its light (radiance_guess.h). 30% less or more: within noise
  // (points in workshop; error below 1%, time 4%).
  RSPHERE_TUNED(SourceParts, double, kNear, .5);
};

}  // namespace rsphere::tuning
