#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean, except those of Relays.
#include <cstddef>

namespace rsphere::tuning {

// Parts of light sources (part_sampler.cpp).
struct PartSampler {
  // The outline of a part of a disk is replaced by a polygon around it, with this many corners for the whole
  // circle. It is 1.3% larger than the disk; samples beside the disk are dropped.
  static constexpr int kCornersOfDisk = 16;
  // Parts that are wider than this, relative to their distance, are sampled by solid angle instead of by
  // area: derived. The edge of a narrower part is at most 3% farther away than its middle, sqrt(1 + .25^2),
  // so that cosine / distance^2 varies little over it.
  static constexpr double kNear = .5;
};

// Images of sources in mirrors, if as many are made as it takes (relays.cpp).
struct Relays {
  // Between two mirrors of reflectance .9, images by up to n reflections show 1 - .9^n of all light that
  // is reflected there: 19, 34 and 57% with 2, 4 and 8. Below a shaft of such mirrors, 2 leave sensors at
  // a tenth (tests/bench/rtrace/runs/2026-11-29-relays.txt).
  static constexpr int kMost = 8;
  // The number of images is at most kFew, and kForEach for each source, with which two parallel mirrors have
  // kMost reflections. Two reflections are followed in any case, as by rtrace's default.
  static constexpr int kUsual = 2;
  static constexpr size_t kFew = 64, kForEach = 16;
};

}  // namespace rsphere::tuning
