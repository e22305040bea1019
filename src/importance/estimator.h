#pragma once
// The quantities of sphere mode at a point: averages over directions that are traced and weighted as -Sw
// says.
//
// Source: Costa, Sousa, Parracho, Cruz, "A New Technique for Spherical Radiance Calculation" (base
// directions; dynamic directions to special objects; weights by spherical Voronoi cells). The strategies:
//   -Sw h  equal_weights.h       base directions alone
//   -Sw v  voronoi_weights.h     the paper's rule
//   -Sw c  silhouette_weights.h  the default; its header lists what differs from the paper, and why
#include <functional>
#include <memory>
#include <vector>

#include "importance/base_set.h"
#include "importance/direction_sample.h"
#include "importance/point_answer.h"
#include "importance/sampling_strategy.h"
#include "importance/seen_sources.h"
#include "importance/special_objects.h"
#include "importance/sphere_options.h"
#include "sphere/voronoi.h"
#include "transport/bright_spots.h"
#include "transport/path_tracer.h"
#include "transport/ray_answer.h"

namespace rsphere {

// Shared by all threads. Keeps a reference to transport.
class SphereEstimator {
 public:
  // Finds the special objects and, for -Sw c, measures how much the radiance on them varies.
  // standardError: whether PointAnswer's is wanted. Throws rad::Error where the base directions'
  // weights fail their check (-Sv).
  SphereEstimator(const Transport& transport, const SphereOptions& options, bool standardError = false);
  SphereEstimator(const SphereEstimator&) = delete;
  SphereEstimator& operator=(const SphereEstimator&) = delete;

  // The state of one thread.
  struct Workspace {
    explicit Workspace(const SphereEstimator& estimator);
    PathTracer tracer;
    // Called before each set of directions; may throw to give the point up.
    std::function<void()> checkStop;
    // The directions of the last point; with -Sa only if every direction is wanted (-Sd), because there may
    // be a million. Where glances found more or less of a guess than the directions did, the difference is
    // added to the directions' radiances in proportion to their guesses, so that solid angles times radiances
    // sum to the answer's. No radiance is negative unless the answer is.
    std::vector<DirectionSample> samples;
    std::vector<Ray> rays;  // of the samples, in the same order; kept with -Sd only

   private:
    friend class SphereEstimator;
    VoronoiWorkspace voronoi_;  // memory that is kept for speed alone
  };

  // The quantities at a point (world), and the directions in workspace.samples. Depends on point, scene
  // and options alone. With -Sa, sets of directions, each turned another way, are averaged until the
  // estimated standard error of the mean's brightness is below that share of it (two_halves.h), or the
  // next set might exceed mostOfAllSets().
  PointAnswer estimate(const V3d& point, Workspace& workspace) const;

  const std::vector<SpecialObject>& specialObjects() const { return special_; }
  const SeenSources& sources() const { return sources_; }

 private:
  std::unique_ptr<const SamplingStrategy> makeStrategy() const;

  const Transport& transport_;
  SphereOptions options_;
  BaseSet base_;
  SeenSources sources_;
  std::vector<SpecialObject> special_;        // none with -Sw h
  std::unique_ptr<const BrightSpots> spots_;  // null: indirect rays are not aimed
  std::unique_ptr<const SamplingStrategy> strategy_;
};

// One direction of a point as -Sd prints it.
RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const Ray& ray);

}  // namespace rsphere
