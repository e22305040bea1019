#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
namespace rsphere::tuning {

// How light sources are divided into parts and sampled (sources.cpp).
struct SourceParts {
  // A part of a plane source is sampled by solid angle instead of by area if its width, relative to its
  // distance, is larger than this: derived. The edge of a narrower part is at most 3% farther away than its
  // middle, sqrt(1 + .25^2), so that cosine / distance^2 varies little over it. Insensitive.
  static constexpr double kNear = .5;
};

}  // namespace rsphere::tuning
