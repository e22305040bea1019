#pragma once
// Strategies of choosing and weighting directions (-Sw), and one set of directions at a point.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "importance/base_set.h"
#include "importance/direction_sample.h"
#include "importance/error_estimate.h"
#include "importance/moments.h"
#include "sphere/voronoi.h"
#include "transport/path_tracer.h"

namespace rsphere {

// One of the sets of directions that are averaged at a point.
class SetAtPoint {
 public:
  // point: world. number: of the sets at this point, from 0. rotation: -Sr. gaze: Moments::gaze.
  SetAtPoint(const V3d& point, uint64_t number, uint64_t rotation, const std::optional<V3d>& gaze = {});

  const V3d& point() const { return point_; }
  const std::optional<V3d>& gaze() const { return gaze_; }

  uint64_t number() const { return number_; }

  // Every random number of the set follows from it. Each strategy adds the number of a stream to it.
  uint64_t seed() const { return seed_; }

  // Whether it is the first set, which uses all directions as they are given.
  bool isFirst() const { return number_ == 0; }

  // The directions as given for the first set; for any other, turned by the random rotation of the set.
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
  Moments excess;               // light found by glances minus the guesses of samples; 0 without glances
  Irradiance clamped;           // light that -Sf removed from moments().total
  Variance variance;            // of moments().total; 0 unless standard errors are wanted
  SharedError shared;           // in addition to variance
  ZoneVariances ofZones;        // as variance
  std::vector<SharedError> sharedByZone;  // in addition to ofZones; empty: none
  size_t litGlances = 0;                  // glances that found light (diffuse_glances.h)

  // The set's estimate of the integrals over all directions. gaze: that of its SetAtPoint.
  Moments moments(const BaseSet& base, const std::optional<V3d>& gaze = {}) const;
};

// Traces each direction once and gives it its solid angle (sr). The random numbers of direction i
// have stream i of the set.
SampledSet traceEach(const SetAtPoint& set, std::span<const V3d> directions,
                     std::span<const double> solidAngles, bool keepRays, PathTracer& tracer);

// A strategy of choosing directions and weighting them. Shared by all threads.
class SamplingStrategy {
 public:
  virtual ~SamplingStrategy() = default;

  // Depends on the set, the scene and the options alone. tracer, memory: the thread's; memory is kept for
  // speed alone. Throws rad::Error if solid angles fail the check of -Sv.
  virtual SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const = 0;
};

}  // namespace rsphere
