#pragma once
// How far a mean of one set of directions is likely to be off, from that set alone.
#include <cstdint>
#include <span>
#include <vector>

#include "importance/direction_sample.h"
#include "importance/seen_sources.h"

namespace rsphere {

// Variance of an integral of radiance, (W/m2)^2: of each channel, and of its brightness, which follows from
// no channel's alone, as the errors of channels go together.
struct Variance {
  Rgb channels{0, 0, 0};
  double brightness = 0;

  // That of one value which is off by so much.
  static Variance of(const Rgb& error) {
    const double b = rsphere::brightness(error);
    return {error * error, b * b};
  }
  Variance& operator+=(const Variance& v) {
    channels += v.channels;
    brightness += v.brightness;
    return *this;
  }
  Variance operator*(double factor) const { return {channels * factor, brightness * factor}; }
};

// Which directions lie beside which on the base: those of direction i at [first[i], first[i + 1]) of
// neighbour.
struct Neighbours {
  std::vector<uint32_t> first, neighbour;
};

// Variance of sum(w L) over the base directions: what of each direction's
// radiance the mean of its neighbours does not tell, times its own solid angle. A slope over the sphere is no
// error, since an even set integrates it; noise of paths and edges are. Directions with counted[i] false,
// which others stand for, take no part. Edges, which a set that is more even than a random one partly
// averages out, count too much by the difference; see tuning::ErrorEstimate.
Variance baseVariance(std::span<const DirectionSample> base, const Neighbours& neighbours,
                      const std::vector<bool>& counted);

// The same for a run of directions that were spread evenly over a region in this order, none beside the one
// before it (dynamic directions): by their variance, made smaller by evenness.
Variance spreadVariance(std::span<const DirectionSample> samples);

// The same for directions to the parts of one source, in the order of the parts: by differences of successive
// ones, as something before the source hides parts that lie together.
Variance partsVariance(std::span<const SeenSources::Sample> samples);

}  // namespace rsphere
