#pragma once
// The radiance that passes through a point from all around, as an average of traced directions, each weighted
// by the solid angle it stands for.
//
// Source: Costa, Sousa, Parracho, Cruz, "A New Technique for Spherical Radiance Calculation" (base
// directions; dynamic directions to special objects; weights by spherical Voronoi cells). What differs with
// -Sw c, the default, and why:
// - Light sources that are seen directly are integrated by themselves (seen_sources.h): they are nearly all
// the error.
// - Cells keep to the silhouettes. The cell of a base direction is its Voronoi cell on the sphere; inside a
// silhouette
//   it is shared with the dynamic directions that were sent there, in proportion to their numbers, and
//   outside it is not touched. Plain cells reach over the silhouette's edge from the dense side and bias the
//   mean by a percent.
// - How many directions a special object gets follows from how much the radiance on it varies, against that
// of the
//   surroundings, measured by rays that take no other part, so that the mean stays unbiased.
#include <optional>
#include <vector>

#include "cli/answer.h"
#include "cli/options.h"
#include "importance/direction_sample.h"
#include "importance/seen_sources.h"
#include "importance/silhouette.h"
#include "importance/special_objects.h"
#include "sphere/voronoi.h"
#include "transport/path_tracer.h"

namespace rsphere {

// What all threads share. Keeps a reference to transport.
class SphereEstimator {
 public:
  // Finds the special objects and, for -Sw c, measures how much the radiance on them varies.
  // Throws rad::Error where the base directions' weights fail their check (-Sv).
  SphereEstimator(const Transport& transport, const SphereOptions& options);

  // What one thread needs.
  struct Workspace {
    explicit Workspace(const SphereEstimator& estimator) : tracer(estimator.transport_) {}
    PathTracer tracer;
    std::vector<DirectionSample> samples;  // of the last point
    std::vector<Ray> rays;                 // what they hit, in the same order; kept with -Sd only

   private:
    friend class SphereEstimator;
    struct Target {
      Silhouette silhouette;
      double expected = 0;  // directions, on average
      double density = 0;   // of them, per sr of its region
    };
    VoronoiWorkspace voronoi;
    std::vector<Target> targets;
    std::vector<V3d> dynamic;
    std::vector<SeenSources::Sample> sources;
    std::vector<size_t> rest;  // samples that no source apart was shown by
  };

  // The quantities at a point (world), and the directions in workspace.samples. Depends on point, scene and
  // options alone.
  PointAnswer estimate(const V3d& point, Workspace& workspace) const;

  const std::vector<SpecialObject>& specialObjects() const { return special_; }

 private:
  void traceInto(Workspace& w, const V3d& point, const V3d& direction, double solidAngle,
                 uint64_t seed) const;
  void sampleAsPaper(const V3d& point, uint64_t seed, Workspace& w) const;
  void sampleSilhouettes(const V3d& point, uint64_t seed, Workspace& w) const;
  void chooseTargets(const V3d& point, uint64_t seed, size_t most, Workspace& w) const;
  void measureContrasts();

  const Transport& transport_;
  SphereOptions options_;
  std::optional<BaseTriangulation> base_;
  std::vector<V3d> directions_;      // of the base
  std::vector<double> solidAngles_;  // of the base, sr
  SeenSources sources_;
  std::vector<SpecialObject> special_;
  std::vector<double> deviations_;  // by special object: standard deviation of the radiance on it, W/sr/m2
};

// The quantities of PointAnswer (all but its standard error) from weighted directions: sums over L w, L w d
// and so on. Definitions: answer.h.
PointAnswer integrate(const V3d& point, const std::vector<DirectionSample>& samples);

// One direction of a point as -Sd prints it.
RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const Ray& ray);

}  // namespace rsphere
