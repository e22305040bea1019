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
// silhouette it is shared with the dynamic directions that were sent there, in proportion to their numbers,
// and outside it is not touched. Plain cells reach over the silhouette's edge from the dense side and bias
// the mean by a percent.
// - How many directions a special object gets follows from how much the radiance on it varies, against that
// of the surroundings, measured by rays that take no other part, so that the mean stays unbiased.
// - Indirect rays are aimed at where much light falls on little (transport/bright_spots.h).
// - Many glances, rays that are not followed beyond what they hit, tell what can be guessed of diffuse
// surfaces (transport/radiance_guess.h): their unshadowed or fully shadowed light, and their edges. Only what
// differs from the guess is left to the directions, and to the indirect rays that they go on with.
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cli/answer.h"
#include "cli/options.h"
#include "importance/direction_sample.h"
#include "importance/error_estimate.h"
#include "importance/moments.h"
#include "importance/seen_sources.h"
#include "importance/special_objects.h"
#include "importance/targets.h"
#include "sphere/voronoi.h"
#include "transport/bright_spots.h"
#include "transport/path_tracer.h"
#include "transport/radiance_guess.h"

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
    explicit Workspace(const SphereEstimator& estimator)
        : tracer(estimator.transport_, estimator.spots_.get()) {
      tracer.gatherFirstAnew();
    }
    PathTracer tracer;
    // Called before each set of directions; may throw to give the point up.
    std::function<void()> checkStop;
    // Of the last point; with -Sa only where every direction is wanted (-Sd), which may be a million. Where
    // glances found more or less than the directions' own guesses say, what is guessed of each is scaled so
    // that solid angles times radiances sum to the answer's; none is negative unless the answer is.
    std::vector<DirectionSample> samples;
    std::vector<Ray> rays;  // what they hit, in the same order; kept with -Sd only

   private:
    friend class SphereEstimator;
    // Of the set that is being sampled:
    std::vector<V3d> directions, dynamic;  // of the base, and to special objects
    std::vector<V3d> turnedGlances;
    std::span<const V3d> glances;
    std::vector<RadianceGuess::Traced> traced;  // by rays that take no other part
    std::optional<LocalGuess> local;            // fitted to these
    double around = 0;                          // mean brightness of these
    std::vector<SeenSources::Image> images;
    std::vector<SeenSources::Sample> sources;
    std::vector<size_t> rest;                  // samples that showed no source that is integrated apart
    std::vector<RadianceGuess::Place> places;  // what they hit, in the same order
    std::vector<bool> counted;                 // which base directions are among them
    std::vector<size_t> runs;  // where directions to a target, or to all parts of one, begin in samples
    Variance variance;         // of the integral of radiance
    std::vector<DirectionSample> unguessed, guessed;  // parts of the base's samples
    Moments excess;            // of what glances found, over what the directions' own guesses say
    std::vector<Rgb> guesses;  // of samples' radiances; empty: none are made
    VoronoiWorkspace voronoi;
  };

  // The quantities at a point (world), and the directions in workspace.samples. Depends on point, scene and
  // options alone.
  // With -Sa, sets of directions, each turned another way, are averaged until the estimated standard error of
  // the mean's brightness is below that share of it (two_halves.h), or the next set might exceed
  // mostOfAllSets().
  PointAnswer estimate(const V3d& point, Workspace& workspace) const;

  const std::vector<SpecialObject>& specialObjects() const { return special_; }
  const SeenSources& sources() const { return sources_; }

 private:
  void traceInto(Workspace& w, const V3d& point, const V3d& direction, double solidAngle,
                 uint64_t seed) const;
  void sampleSet(const V3d& point, uint64_t set, Workspace& w) const;
  void sampleEqually(const V3d& point, uint64_t seed, Workspace& w) const;
  void sampleAsPaper(const V3d& point, uint64_t seed, Workspace& w) const;
  void sampleSilhouettes(const V3d& point, uint64_t seed, Workspace& w) const;
  void lookAround(const V3d& point, uint64_t seed, Workspace& w) const;
  void glance(const V3d& point, Workspace& w) const;
  void addVariances(size_t firstBase, Workspace& w) const;

  const Transport& transport_;
  SphereOptions options_;
  std::optional<BaseTriangulation> base_;
  std::vector<V3d> directions_;      // of the base
  std::vector<double> solidAngles_;  // of the base, sr
  SeenSources sources_;
  bool standardError_;
  Neighbours neighbours_;  // of the base, where errors are wanted
  std::vector<SpecialObject> special_;
  std::optional<TargetChoice> targets_;
  std::optional<RadianceGuess> guess_;
  std::unique_ptr<const BrightSpots> spots_;  // null where light falls evenly
  std::vector<V3d> glances_, fitGlances_;
};

// One direction of a point as -Sd prints it.
RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const Ray& ray);

}  // namespace rsphere
