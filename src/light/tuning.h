#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.

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

}  // namespace rsphere::tuning
