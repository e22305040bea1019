#pragma once
// Glare at an eye: the light that it receives from all directions, and the part that comes from glare
// sources.
//
// - Visible light sources of the scene, except distant ones: each is a glare source, whatever its luminance
//   (CIE 117). Their solid angles are known, and shadow rays find the visible part (seen_sources.h).
// - Everything else that is brighter than a threshold (GlareOptions): the sky and the sun, images in mirrors,
//   sunlit and other bright surfaces. As in evalglare, bright directions that are near each other form one
//   source, and peaks among them, such as the sun, form separate sources. The directions are those of the
//   spherical mean, whose cells end at the outlines of openings, sunlit spots and other known objects; there
//   are no pixels.
//
// The indirect light of a direction comes from one path and is noisy. The threshold is therefore compared
// with a smooth fit to the surrounding directions that see this surface (local_fits.h). The fit leaves out
// the direction's own path, so that the noise of that path does not decide whether the direction belongs to a
// source. The integrals over a source contain the light that the paths found, not the fit.
//
// Several independent sets of directions are averaged. Standard errors are jackknife estimates: each set is
// left out in turn, and the sources are found again without it. The errors of single sources, however, are
// computed for the directions that belong to them in the whole answer.

#include "estimate/estimator.h"
#include "glances/tuning.h"
#include "points/glare_answer.h"

namespace rsphere {

// Shared by all threads. Keeps a reference to the transport.
class GlareEstimator {
 public:
  // Number of sets of directions. Each has a separate pool of light vertices, so that all errors are
  // independent between sets.
  static constexpr size_t kSets = tuning::DiffuseGlances::kPools;

  // options: as for SphereEstimator, with -Sw c.
  GlareEstimator(const Transport& transport, const SphereOptions& options);

  // The estimator of means. Its Workspace is also the state of one thread here.
  const SphereEstimator& means() const { return means_; }

  // The answer depends only on the eye, the gaze, the scene and the options. eye: world.
  GlareAnswer estimate(const V3d& eye, const Gaze& gaze, SphereEstimator::Workspace& workspace) const;

 private:
  struct Look;
  struct View;
  struct Source;
  using Sources = std::vector<Source>;
  struct Found {
    Sources sources;
    double threshold = 0;
    GlareIndices indices, shifted;  // shifted: changed by the error that all sets share
  };

  void addSet(const SetAtPoint& set, SphereEstimator::Workspace& workspace, View& view) const;
  Look lookAlong(const SetAtPoint& set, size_t number, const DirectionSample& sample, const TracedRay& ray,
                 PathTracer& tracer) const;
  void retrace(const V3d& eye, uint64_t seed, PathTracer& tracer, Look& look) const;
  double taskLuminance(const SetAtPoint& set, const Gaze& gaze, PathTracer& tracer) const;
  bool isLamp(SurfaceId surface) const;
  double threshold(const View& view) const;
  void addLamps(const View& view, Sources& sources) const;
  void addBright(const View& view, double threshold, Sources& sources) const;
  // Finds the glare sources of a view, and computes the indices.
  Found find(View view) const;
  double luminance(const Radiance& radiance) const;

  const PreparedScene& prepared_;
  SphereOptions options_;
  SphereEstimator means_;
  bool separates_;  // whether the indirect light of a ray can be separated from its other light
};

}  // namespace rsphere
