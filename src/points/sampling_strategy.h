#pragma once
// Strategies that choose and weight directions (-Sw), and one set of directions at a point.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "points/base_set.h"
#include "points/direction_sample.h"
#include "points/error_estimate.h"
#include "points/moments.h"
#include "sphere/voronoi.h"
#include "transport/path_tracer.h"

namespace rsphere {

// One of the sets of directions that are averaged at a point.
class SetAtPoint {
 public:
  // point: world. number: of the set, from 0. rotation: -Sr. gaze: Moments::gaze.
  SetAtPoint(const V3d& point, uint64_t number, uint64_t rotation, const std::optional<V3d>& gaze = {});

  const V3d& point() const { return point_; }
  const std::optional<V3d>& gaze() const { return gaze_; }

  uint64_t number() const { return number_; }

  // All random numbers of the set follow from this seed. A strategy adds the number of a stream to it.
  uint64_t seed() const { return seed_; }

  // Whether it is the first set, whose directions are not turned.
  bool isFirst() const { return number_ == 0; }

  // Applies the set's random rotation to the directions. The first set keeps them as they are.
  std::vector<V3d> turned(std::span<const V3d> directions) const;

 private:
  V3d point_;
  std::optional<V3d> gaze_;
  uint64_t number_, seed_;
};

// The directions of one set, traced and weighted.
struct SampledSet {
  std::vector<DirectionSample> samples;
  std::vector<TracedRay> rays;  // of the samples, in the same order; kept with -Sd only
  Moments excess;               // light found by glances, minus the light of glances along samples
                                // (DirectionSample::glanced); 0 without glances
  Variance variance;            // of moments().total; 0 unless standard errors are wanted
  SharedError shared;           // error due to light vertices, not in `variance`
  KernelVariances ofKernels;    // `variance` by zone and quantity (kernels.h)
  std::vector<SharedError> sharedByKernel;  // `shared` likewise; empty without any
  size_t litGlances = 0;                    // glances that found light (diffuse_glances.h)

  // Sets the variance, and those of zones and quantities, from the differences between neighbouring samples.
  void setVariance(const Neighbours& neighbours, const BaseSet& base);

  // The set's estimate of the integrals over all directions. gaze: that of its SetAtPoint.
  Moments moments(const BaseSet& base, const std::optional<V3d>& gaze = {}) const;
};

// Traces each direction once and gives it its solid angle (sr). Direction i uses random numbers of stream i
// of the set.
SampledSet traceEach(const SetAtPoint& set, std::span<const V3d> directions,
                     std::span<const double> solidAngles, bool keepRays, PathTracer& tracer);

// A strategy that chooses and weights directions. Shared by all threads.
class SamplingStrategy {
 public:
  virtual ~SamplingStrategy() = default;

  // Traces one set of directions. The result depends only on the set, the scene and the options. tracer,
  // memory: of the calling thread; memory only saves time.
  virtual SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const = 0;
};

}  // namespace rsphere
