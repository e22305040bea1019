#pragma once
// Estimates the variance of a mean from the samples of one set of directions. The light of glances is left
// out, because diffuse_glances.h estimates its variance. Parameters of all functions: sampling is
// RayOptions::sampling; the variance of each zone is added to `to`, which is null without zones.
#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

#include "base/colorimetry.h"
#include "points/direction_sample.h"
#include "points/kernels.h"

namespace rsphere {

// Variance of an integral of radiance, (W/m2)^2, for each channel or band, and for the brightness (in a
// spectral run, the photopic integral). The variance of the brightness is separate, because it does not
// follow from those of the channels, whose errors are correlated.
struct Variance {
  Color channels{0, 0, 0};
  double brightness = 0;

  // The square of one error.
  static Variance of(const Irradiance& error, const SpectralSampling* sampling) {
    const double b = photopicOf(error.color, sampling);
    return {error.color * error.color, b * b};
  }
  Variance& operator+=(const Variance& v) {
    channels += v.channels;
    brightness += v.brightness;
    return *this;
  }
  Variance operator*(double factor) const { return {channels * factor, brightness * factor}; }
};

// The error due to light vertices. All directions of a point, and all points, share these vertices.
struct SharedError {
  std::vector<Irradiance> batches;  // sums of contributions by batch of light paths; empty: no light vertices
  Variance chosen;                  // part of their spread that is due to choosing vertices at random

  void add(const SharedError& other, double share);
};
// The variance of the shared error, from the differences between batches.
Variance sharedVariance(const SharedError& error, const SpectralSampling* sampling);
// The variance of the shared error plus that of the directions, `own`. The sum is at least a fraction of the
// spread of the batches (tuning::ErrorEstimate::kLeastShared).
Variance varianceWith(const SharedError& error, Variance own, const SpectralSampling* sampling);

// The variances of the zones (-Sz) and quantities that have standard errors of their own.
struct KernelVariances {
  Kernels kernels;
  std::vector<Variance> all;

  explicit KernelVariances(const Kernels& of = {}) : kernels(of), all(of.count()) {}
  // Adds the variance of one direction's contribution to the mean, which is independent of all others.
  void add(const V3d& direction, const Variance& variance);
  // The same for zones alone. cell: as for Moments::add().
  void addToZones(const V3d& direction, double cell, const Variance& variance);
  // Adds varianceOf(quantity) to each quantity: the variance of the mean of samples that are weighted by it.
  // Evenly spread directions integrate a radiance that does not vary without an error, but not what it is
  // weighted by.
  template <class VarianceOf>
  void addQuantities(const VarianceOf& varianceOf) {
    for (size_t i = 0; i < Kernels::kQuantities; ++i)
      if (kernels.quantities[i]) all[kernels.zoneCount() + i] += varianceOf(i);
  }
  void add(const KernelVariances& other, double factor);
};

// The samples with their radiance times the weight of a quantity.
std::vector<DirectionSample> weighted(std::span<const DirectionSample> samples, const Kernels& kernels,
                                      size_t quantity);

// The neighbours of each direction. Those of direction i are neighbour[first[i]] to neighbour[first[i + 1] -
// 1].
struct Neighbours {
  std::vector<uint32_t> first, neighbour;
};

// Variance of the sum of solid angle times radiance over evenly spread directions. Each contributes its solid
// angle times the second difference of radiance: its difference to the mean of its neighbours, minus the mean
// of the neighbours' differences. Second differences contain the noise of paths and the error at edges, but
// not smooth variation, which an even set integrates accurately. An even set also averages out part of the
// error at edges, hence the factor tuning::ErrorEstimate::kEvenSet. In regions other than 0, the factor is 1
// for directions with few neighbours, because a single one may find much light there, such as a lamp mirrored
// in a chrome column. The mean of a region takes the place of neighbours in other regions: cells end at the
// edge of a region and add up to its solid angle, so that there only what differs from the mean is uncertain.
// Directions in kNoRegion are left out.
Variance evenVariance(std::span<const DirectionSample> samples, const Neighbours& neighbours,
                      const SpectralSampling* sampling, KernelVariances* to = nullptr);

// evenVariance() for dynamic directions to one target, whose places in it are the first points of evenly().
// Each is compared with the nearest ones. An edge, such as that of a window in a mirror, then counts only
// where it passes between neighbours. Slats that are finer than the distance of neighbours count as noise.
Variance latticeVariance(std::span<const DirectionSample> samples, const Imath::V2d& shift,
                         const SpectralSampling* sampling, KernelVariances* to = nullptr);

// evenVariance() for dynamic directions to several targets that show parts of one image of a source. The
// result is the variance of independent directions, reduced because they are evenly spread. It is not reduced
// where few directions find most of the light, for example of a lamp that is mirrored twice.
Variance spreadVariance(std::span<const DirectionSample> samples, const SpectralSampling* sampling,
                        KernelVariances* to = nullptr);

// evenVariance() for a target with a single dynamic direction. The direction is compared with the base
// directions in its region; if there are none, its whole contribution is the error.
Variance loneVariance(const DirectionSample& sample, std::span<const DirectionSample> base,
                      const SpectralSampling* sampling, KernelVariances* to = nullptr);

// Variance due to occluders that no direction has hit, in regions other than 0. In each region, an occluder
// is assumed that hides half of the solid angle that one more direction would represent. Otherwise the stated
// error of the light of an opening would be 0 whenever its few directions see an even sky. The assumed
// occluder also hides light that was found by glances.
Variance unseenVariance(std::span<const DirectionSample> samples, const SpectralSampling* sampling,
                        KernelVariances* to = nullptr);

}  // namespace rsphere
