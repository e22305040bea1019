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
#include "importance/error_estimate.h"
#include "importance/seen_sources.h"
#include "importance/silhouette.h"
#include "importance/silhouette_index.h"
#include "importance/special_objects.h"
#include "sphere/voronoi.h"
#include "transport/path_tracer.h"

namespace rsphere {

// What all threads share. Keeps a reference to transport.
class SphereEstimator {
 public:
  // Finds the special objects and, for -Sw c, measures how much the radiance on them varies. standardError:
  // whether PointAnswer's is wanted. Throws rad::Error where the base directions' weights fail their check
  // (-Sv).
  SphereEstimator(const Transport& transport, const SphereOptions& options, bool standardError = false);

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
    // Of the set that is being sampled:
    std::vector<V3d> directions, dynamic;  // of the base, and to special objects
    std::vector<Target> targets;
    SilhouetteIndex index;  // of the targets, by their places there
    std::vector<SeenSources::Image> images;
    std::vector<SeenSources::Sample> sources;
    std::vector<size_t> rest;   // samples that showed no source that is integrated apart
    std::vector<bool> counted;  // which base directions are among them
    std::vector<size_t> runs;   // where each target's directions begin in samples
    Rgb variance{0, 0, 0};      // of the integral of radiance
    VoronoiWorkspace voronoi;
  };

  // The quantities at a point (world), and the directions in workspace.samples. Depends on point, scene and
  // options alone. With -Sa, sets of directions are added, each turned another way, until the estimated
  // standard error of the mean's brightness is below that share of it, or the next set would exceed -Sx.
  PointAnswer estimate(const V3d& point, Workspace& workspace) const;

  const std::vector<SpecialObject>& specialObjects() const { return special_; }

 private:
  void traceInto(Workspace& w, const V3d& point, const V3d& direction, double solidAngle,
                 uint64_t seed) const;
  void sampleSet(const V3d& point, uint64_t set, Workspace& w) const;
  void sampleEqually(const V3d& point, uint64_t seed, Workspace& w) const;
  void sampleAsPaper(const V3d& point, uint64_t seed, Workspace& w) const;
  void sampleSilhouettes(const V3d& point, uint64_t seed, Workspace& w) const;
  void chooseTargets(const V3d& point, uint64_t seed, size_t most, Workspace& w) const;
  void addVariances(size_t firstBase, Workspace& w) const;
  void measureContrasts();
  void measureSurroundings(PathTracer& tracer);

  const Transport& transport_;
  SphereOptions options_;
  std::optional<BaseTriangulation> base_;
  std::vector<V3d> directions_;      // of the base
  std::vector<double> solidAngles_;  // of the base, sr
  SeenSources sources_;
  bool standardError_;
  Neighbours neighbours_;  // of the base, where errors are wanted
  std::vector<SpecialObject> special_;
  // What may get directions of its own with -Sw c: special objects, and what is near to a light source.
  struct Candidate {
    SpecialObject object;
    double deviation = 0;  // of the radiance on it, W/sr/m2
  };
  std::vector<Candidate> candidates_;
  double usualDeviation_ = 1;  // of one base direction's radiance, as a share of the mean, sources apart
};

// The quantities of PointAnswer (all but its standard error) from weighted directions: sums over L w, L w d
// and so on. Definitions: answer.h.
PointAnswer integrate(const V3d& point, const std::vector<DirectionSample>& samples);

// One direction of a point as -Sd prints it.
RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const Ray& ray);

}  // namespace rsphere
