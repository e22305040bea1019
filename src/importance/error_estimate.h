#pragma once
// The variance of an estimate from one set of directions, computed from that set alone. Guesses are
// subtracted from the radiances, because glances estimate them. Parameters of all functions: sampling is
// RayOptions::sampling; the variance by zone is added to `to`, which is null without zones.
#include <cstdint>
#include <span>
#include <vector>

#include "base/colorimetry.h"
#include "importance/direction_sample.h"
#include "importance/seen_sources.h"
#include "sphere/equal_zones.h"

namespace rsphere {

// Variance of an integral of radiance, (W/m2)^2, for each channel and band and for the brightness, which in a
// spectral run is the photopic integral. The variance of the brightness does not follow from those of the
// channels, because the errors of channels are correlated.
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

// The error due to light vertices. It is common to all directions of a point, and to all points.
struct SharedError {
  std::vector<Irradiance> batches;  // sums of contributions by batch of light paths; empty: no light vertices
  Variance chosen;  // the part of the batches' spread that is due to the choice of vertices for each glance

  void add(const SharedError& other, double share);
};
// The variance of the shared error, from the differences between batches.
Variance sharedVariance(const SharedError& error, const SpectralSampling* sampling);
// The sum of the shared variance and of the directions' own. It is at least a part of the spread of the
// batches (tuning::ErrorEstimate::kLeastShared).
Variance varianceWith(const SharedError& error, Variance own, const SpectralSampling* sampling);

// The variances of zones of directions (-Sz).
struct ZoneVariances {
  const EqualZones* zones = nullptr;  // null: there are none
  std::vector<Variance> all;

  explicit ZoneVariances(const EqualZones* by = nullptr) : zones(by), all(by ? by->count() : 0) {}
  // Adds the variance of what a direction contributes. cell: as for Moments::add().
  void add(const V3d& direction, double cell, const Variance& variance);
  void add(const ZoneVariances& other, double factor);
};

// Null if there are no zones.
inline ZoneVariances* zonesOf(ZoneVariances& variances) { return variances.zones ? &variances : nullptr; }

// The neighbours of each direction on the sphere: those of direction i are neighbour[first[i]] to
// neighbour[first[i + 1] - 1].
struct Neighbours {
  std::vector<uint32_t> first, neighbour;
};

// Variance of the sum of solid angle times radiance over even directions. Each contributes its solid angle
// times its second difference: the difference between its radiance and the mean of its neighbours, minus the
// mean of the neighbours' differences. This contains the noise of paths and the error due to edges, but not
// light that varies smoothly, which an even set integrates accurately. An even set also averages out a part
// of the error due to edges, so that the sum is multiplied by tuning::ErrorEstimate::kEvenSet. In regions
// other than 0 the factor is 1, because single directions there may find much light, such as a lamp that a
// chrome column mirrors. Only neighbours in the same region are compared, if there are any: the edge of a
// region is no error, because cells keep to regions. Directions in kNoRegion are left out.
Variance evenVariance(std::span<const DirectionSample> samples, const Neighbours& neighbours,
                      const SpectralSampling* sampling, ZoneVariances* to = nullptr);

// The same for a run of dynamic directions. They are spread evenly over a region, but successive ones are not
// neighbours. It is the variance of independent directions, reduced because the directions are evenly spread.
// It is not reduced where few of them find most of the light, such as that of a lamp that is mirrored twice.
Variance spreadVariance(std::span<const DirectionSample> samples, const SpectralSampling* sampling,
                        ZoneVariances* to = nullptr);

// The same for a run of a single direction in a region. It is compared with the base directions in that
// region. If there are none, its whole contribution is taken as the error.
Variance loneVariance(const DirectionSample& sample, std::span<const DirectionSample> base,
                      const SpectralSampling* sampling, ZoneVariances* to = nullptr);

// Variance from occluders that no direction has hit, in regions other than 0. In each region, an occluder is
// assumed that hides half of the solid angle that one more direction would represent. Without it, the stated
// error of the light of an opening to which few directions were sent would be 0 whenever all of them see the
// same sky. The occluder also hides light that is guessed.
Variance unseenVariance(std::span<const DirectionSample> samples, const SpectralSampling* sampling,
                        ZoneVariances* to = nullptr);

// The variance of the samples of one image of a light source, in the order of its grid. It is computed from
// differences between neighbouring cells, because an occluder hides cells that lie together.
Variance partsVariance(std::span<const SeenSources::Sample> samples, const SpectralSampling* sampling,
                       ZoneVariances* to = nullptr);

// The variance due to the random choice of images, which is necessary if there are more images than samples.
// It is computed from differences between images that are chosen in succession. samples: of all images.
Variance choiceVariance(std::span<const SeenSources::Sample> samples, const SpectralSampling* sampling,
                        ZoneVariances* to = nullptr);

}  // namespace rsphere
