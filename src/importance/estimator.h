#pragma once
// Computes the quantities of sphere mode at a point from traced directions, which -Sw chooses and weights.
//
// Source: Costa, Sousa, Parracho, Cruz, "A New Technique for Spherical Radiance Calculation" (base
// directions; dynamic directions to special objects; weights by spherical Voronoi cells). The strategies:
//   -Sw h  equal_weights.h       base directions alone
//   -Sw v  voronoi_weights.h     the paper's rule
//   -Sw c  silhouette_weights.h  the default; its header lists the differences from the paper, with reasons
#include <functional>
#include <memory>
#include <vector>

#include "importance/base_set.h"
#include "importance/diffuse_glances.h"
#include "importance/direction_sample.h"
#include "importance/point_answer.h"
#include "importance/sampling_strategy.h"
#include "importance/seen_sources.h"
#include "importance/special_objects.h"
#include "importance/sphere_options.h"
#include "importance/sphere_tracing.h"
#include "sphere/voronoi.h"
#include "transport/ray_answer.h"
#include "transport/transport.h"

namespace rsphere {

// Shared by all threads. Keeps references to transport.
class SphereEstimator {
 public:
  // Finds the special objects and, for -Sw c, measures how much the radiance on them varies. standardError:
  // whether PointAnswer's standard errors are wanted; -Sa computes them in any case. Throws rad::Error if the
  // solid angles of the base directions fail the check of -Sv.
  SphereEstimator(const Transport& transport, const SphereOptions& options, bool standardError = false);
  SphereEstimator(const SphereEstimator&) = delete;
  SphereEstimator& operator=(const SphereEstimator&) = delete;

  // The state of one thread.
  struct Workspace {
    explicit Workspace(const SphereEstimator& estimator);
    PathTracer tracer;
    // Called before each set of directions; may throw to abandon the point.
    std::function<void()> checkStop;
    // The directions of the last point; with -Sa only if every direction is wanted (-Sd), because there may
    // be a million. With -Sd, their radiances times solid angles sum to the integral of the answer: the
    // difference between the integrals of the guess by glances and by directions is distributed among the
    // radiances in proportion to their guesses. No radiance is negative unless the answer is.
    std::vector<DirectionSample> samples;
    std::vector<TracedRay> rays;  // of the samples, in the same order; kept with -Sd only

   private:
    friend class SphereEstimator;
    VoronoiWorkspace voronoi_;  // memory that is kept for speed alone
  };

  // The quantities at a point (world); the directions are left in workspace.samples. The answer depends on
  // the point, the scene and the options alone. With -Sa, sets of directions with different rotations are
  // averaged until the estimated standard error of the brightness of the mean is below that fraction of it
  // (two_halves.h), or until the next set might exceed SphereOptions::mostOfAllSets(), or at a dark point
  // after tuning::Dark::kSets sets.
  PointAnswer estimate(const V3d& point, Workspace& workspace) const;

  // One set of directions, and its integrals. The mean of the integrals over sets is an estimate like that of
  // estimate(). Sets of different numbers below DiffuseGlances::kPools are independent of each other.
  SampledSet sampleSet(const SetAtPoint& set, Workspace& workspace) const {
    return strategy_->sample(set, workspace.tracer, workspace.voronoi_);
  }
  Moments momentsOf(const SampledSet& sampled, const SetAtPoint& set) const {
    return sampled.moments(base_, set.gaze());
  }
  // The relative standard error that all sets and points share: that of the coarse solution (-aa above 0).
  double sharedError() const;

  const SeenSources& sources() const { return sources_; }

 private:
  bool isDark(const PointAnswer& answer, size_t lit) const;
  std::unique_ptr<const SamplingStrategy> makeStrategy() const;

  SphereOptions options_;
  BaseSet base_;
  SeenSources sources_;
  std::vector<SpecialObject> special_;             // none with -Sw h
  std::unique_ptr<const DiffuseGlances> glances_;  // null where light vertices do not bring all of the light
  SphereTracing tracing_;
  std::unique_ptr<const SamplingStrategy> strategy_;
  double dark_ = 0;  // -Sa: points with a smaller integral of radiance are dark, W/m2
};

// One direction of a point as -Sd prints it.
RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const TracedRay& ray);

}  // namespace rsphere
