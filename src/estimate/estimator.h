#pragma once
// Computes the quantities of sphere mode at a point from traced directions. -Sw is the strategy that chooses
// and weights them.
//
// Source: Costa, Sousa, Parracho, Cruz, "A New Technique for Spherical Radiance Calculation" (base
// directions; dynamic directions to special objects; weights by spherical Voronoi cells). The strategies:
//   -Sw h  equal_weights.h       base directions alone
//   -Sw v  voronoi_weights.h     the paper's rule
//   -Sw c  silhouette_weights.h  the default; its header lists the differences from the paper, with reasons
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "glances/diffuse_glances.h"
#include "glances/sphere_tracing.h"
#include "points/base_set.h"
#include "points/direction_sample.h"
#include "points/point_answer.h"
#include "points/sampling_strategy.h"
#include "points/sphere_options.h"
#include "rays/ray_answer.h"
#include "silhouettes/seen_sources.h"
#include "silhouettes/special_objects.h"
#include "sphere/voronoi.h"
#include "transport/transport.h"

namespace rsphere {

// Shared by all threads. Keeps references to transport.
class SphereEstimator {
 public:
  // Finds the special objects and, for -Sw c, measures how much the radiance on them varies. standardError:
  // whether PointAnswer should contain standard errors; -Sa computes them in any case.
  SphereEstimator(const Transport& transport, const SphereOptions& options, bool standardError = false);
  SphereEstimator(const SphereEstimator&) = delete;
  SphereEstimator& operator=(const SphereEstimator&) = delete;

  // The state of one thread.
  struct Workspace {
    explicit Workspace(const SphereEstimator& estimator);
    PathTracer tracer;
    // The directions of the last point. With -Sa they are kept only if every direction is requested (-Sd),
    // because there may be a million. With -Sd, their radiances times solid angles sum to the integral of the
    // answer: SampledSet::excess is distributed among the radiances in proportion to the light of the glances
    // along the directions. No radiance is negative unless the answer is.
    std::vector<DirectionSample> samples;
    std::vector<TracedRay> rays;  // of the samples, in their order; kept with -Sd only

   private:
    friend class SphereEstimator;
    VoronoiWorkspace voronoi_;  // reused memory, without influence on answers
  };

  // The quantities at a point (world); the directions are left in workspace.samples. The answer depends only
  // on the point, the scene and the options. With -Sa, sets of directions with different rotations are
  // averaged until the estimated standard error of the brightness is below the fraction -Sa of the mean
  // (two_halves.h). They end early if the next set might exceed SphereOptions::mostOfAllSets(), and at a dark
  // point after tuning::DiffuseGlances::kPools sets.
  PointAnswer estimate(const V3d& point, Workspace& workspace) const;

  // Traces one set of directions. The integrals of one set estimate the integrals at the point; estimate()
  // averages them over sets. Sets with different numbers below tuning::DiffuseGlances::kPools are independent
  // of each other.
  SampledSet sampleSet(const SetAtPoint& set, Workspace& workspace) const {
    return usual_.strategy->sample(set, workspace.tracer, workspace.voronoi_);
  }
  Moments momentsOf(const SampledSet& sampled, const SetAtPoint& set) const {
    return sampled.moments(base_, set.gaze());
  }
  // The relative standard error of the coarse solution (-aa above 0), which all sets and points share.
  double sharedError() const;

  const SeenSources& sources() const { return sources_; }

 private:
  bool isDark(const PointAnswer& answer, size_t lit) const;
  // How sets of directions are traced and weighted.
  struct Method {
    std::unique_ptr<const DiffuseGlances> glances;  // null where light vertices miss some of the light
    SphereTracing tracing;
    std::unique_ptr<const SamplingStrategy> strategy{};
  };
  static Method usualMethod(const Transport& transport, const SphereOptions& options, const BaseSet& base);
  std::unique_ptr<const SamplingStrategy> makeStrategy(const Method& method) const;
  Method daylitMethod(const PlainSurfaces& surfaces) const;
  const SamplingStrategy& strategyFor(const V3d& point) const;

  SphereOptions options_;
  BaseSet base_;
  SeenSources sources_;
  std::vector<SpecialObject> special_;  // none with -Sw h
  Method usual_;
  // For points in rooms that daylight enters through openings. The method is made for the first such point.
  struct Daylit {
    explicit Daylit(PlainSurfaces all) : surfaces(std::move(all)) {}
    PlainSurfaces surfaces;
    std::once_flag made;
    std::optional<Method> method;
  };
  std::unique_ptr<Daylit> daylit_;  // null without openings
  double floor_ = 0;                // -Sa: integral of radiance (W/m2) to which it refers at least
  double dark_ = 0;                 // -Sa: integral of radiance (W/m2) below which a point is dark
};

// One direction of a point, as -Sd prints it.
RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const TracedRay& ray);

}  // namespace rsphere
