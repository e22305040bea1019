#pragma once
// The value of a ray with its standard error (-oe in ray mode), and as many rays as an accuracy takes (-Sa).
//
// A ray is estimated kSets times, each time with random numbers, shadow rays, samples of lobes and a gather
// of its own. Its value is the mean of these sets, and its standard error follows from their spread. The sets
// are the batches of the Monte Carlo method: each gather is stratified by itself, so that the sets are
// independent and no assumption about strata is made.
//
// With -aa above 0, the light of the first diffuse surface is gathered and not interpolated, because the
// error of an interpolation does not follow from any spread. The light of later surfaces comes from patches
// (coarse_solution.h), whose noise is common to all rays. Each set therefore uses a solution of its own. The
// error is at least that which the spread of the means of sets shows. The gathers of each two sets then
// share a lattice (PathRequest::interleaved): together they are more even than independent ones, and their
// spread states an error that is rather too large. Without patches, it would be far too large.
//
// -Sa: the sets are divided into two halves. The gathers of one half decide how many rays the sets of the
// other half get, so that the number of rays does not depend on the values that are averaged: a half that
// misses something bright seems less noisy than it is. If the stated error is still too large, all sets get
// more rays; this causes the remaining bias (two_halves.h has measured it for points). Where the solutions
// differ by much more than the accuracy, more rays do not help: the ray is then estimated by paths that use
// no patches. Where no ray finds light, the error is that of one ray more that finds the average radiance.
#include <vector>

#include "base/function_ref.h"
#include "transport/transport.h"

namespace rsphere {

class RayEstimator {
 public:
  static constexpr size_t kSets = 8, kSolutions = kSets;  // the sets of a ray share no patches

  struct Options {
    double accuracy = 0;  // -Sa  largest standard error relative to the value; 0: one round of sets
    // -Sa  A value below this counts as if it were this large (W/sr/m2, or W/m2 for irradiance); below 0: a
    // fraction of the average radiance in view of the scene's surfaces.
    double floor = -1;
  };
  // Keeps a reference to the transport. REQUIRES that with -aa above 0, its RayOptions::solutions is
  // kSolutions.
  RayEstimator(const Transport& transport, const Options& options);

  // The rays of patches (RayOptions::raysForPatches) with which an accuracy can be reached.
  static double raysForPatches(const RayOptions& options, double accuracy);

  // What one thread needs: a tracer for each solution and, with -Sa, one that uses no patches.
  std::vector<PathTracer> tracers() const;

  struct Estimate {
    TracedRay ray;               // of the first set, with the mean value and the mean mirrored light of all
    Radiance standardError;      // of the value, by channel or band
    double brightnessError = 0;  // of its brightness; in a spectral run, of its photopic value
    // brightnessError relative to the value, or to the floor of -Sa if that is larger.
    double relativeError = 0;
    bool reached = true;  // whether this is within the accuracy
  };
  // Parameters: PathTracer::trace(). The request may have no observer. tracers: of this thread.
  Estimate estimate(std::vector<PathTracer>& tracers, const V3d& origin, const V3d& direction,
                    double farthest, uint64_t seed, PathRequest request = {}) const;

  // Traces the ray once, for a set (below kSets), with this number of rays in the gather of its first diffuse
  // surface and a seed of its own. The sets of a half, those below kSets / 2 or the others, have as many rays
  // each. together: the same for one gather of each of kInterleavedGathers sets of a half.
  struct Sent {
    size_t set;
    int rays;
    uint64_t seed, together;
  };
  using Gather = FunctionRef<TracedRay(const Sent& sent)>;
  // The same for any quantity of the ray: `gather` puts it into TracedRay::value.
  Estimate estimate(const Gather& gather, uint64_t seed) const;

 private:
  struct Attempt {
    Estimate estimate;
    bool patchesTooNoisy = false;  // for the accuracy, which was given up
  };
  Attempt attempt(const Gather& gather, uint64_t seed, bool usesPatches) const;

  const Transport& transport_;
  Options options_;
  double target_ = 0;            // relative error at which no more rays are sent; 0: one round of sets
  double floor_ = 0, most_ = 0;  // most_: rays of a set
  double usual_ = 0;             // -Sa  value of a ray or sensor that sees the average radiance of the scene
  int first_ = 1;                // rays of a set in the first round
};

}  // namespace rsphere
