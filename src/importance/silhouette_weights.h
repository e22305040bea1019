#pragma once
#include <optional>
#include <span>
#include <vector>

#include "importance/base_set.h"
#include "importance/diffuse_glances.h"
#include "importance/direction_guide.h"
#include "importance/sampling_strategy.h"
#include "importance/seen_sources.h"
#include "importance/targets.h"
#include "transport/radiance_guess.h"

namespace rsphere {

// -Sw c, the default. It differs from the paper's rule (voronoi_weights.h) as follows:
// - Light sources that are seen directly cause nearly all of the variance, so they are integrated
//   separately (seen_sources.h).
// - Cells keep to the silhouettes. The cell of a base direction is its Voronoi cell on the sphere; inside a
//   silhouette it is shared with the dynamic directions that were sent there, in proportion to their numbers.
//   All cells in a silhouette add up to its solid angle, unless others overlap it, and those outside to that
//   of the rest (cells_in_targets.h). Plain cells reach over the silhouette's edge from the dense side and
//   bias the mean by a percent.
// - How many directions a special object gets follows from how much the radiance on it varies, compared with
//   the surroundings. That is measured by separate rays, so that the mean stays unbiased (targets.h).
//   Openings that show daylight, and spots of sunlight that enters through them, also get directions of their
//   own.
// - Where light is uneven, as around a goal, more directions follow it (direction_guide.h).
// - Indirect rays are aimed at openings that daylight enters through (transport/openings.h), and at diffuse
//   surfaces that receive much direct light (transport/bright_spots.h).
// - Where light vertices bring all of the light, the light of diffuse surfaces does not come from these
//   directions but from many glances, and from shadow rays to light vertices (diffuse_glances.h).
// - Elsewhere a control variate reduces the variance of diffuse surfaces (transport/radiance_guess.h). Many
//   glances, rays that are not followed beyond their first hit, estimate its integral. Directions, and the
//   indirect rays that they spawn, only estimate the difference.
// With -Sk 0 only the first of these is left.
class SilhouetteWeights : public SamplingStrategy {
 public:
  // Keeps references to all of them. patches: null where light is even. glances: null where they do not find
  // all of the light of diffuse surfaces; otherwise they take the place of the guess.
  SilhouetteWeights(const SphereTracing& tracing, const SphereOptions& options, const BaseSet& base,
                    std::span<const SpecialObject> special, const SeenSources& sources,
                    const LightPatches* patches, const DiffuseGlances* glances);

  SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const override;

 private:
  using Images = std::vector<SeenSources::Image>;

  // The means to reduce the variance of light that does not come directly from sources.
  struct Guidance {
    TargetChoice targets;
    RadianceGuess guess;
    std::vector<V3d> glances, fitGlances;
    std::optional<Neighbours> neighbours;  // of glances, if standard errors are wanted
    const Tracer& tracer;
    const LightPatches* patches;  // null where light is even
  };

  // Findings of separate rays around a point that show no image of a light source.
  struct Surroundings {
    std::vector<RadianceGuess::Traced> traced;
    double meanBrightness = 0;  // W/sr/m2
  };

  // The directions that are not sent to images of light sources.
  struct Others {
    std::vector<DirectionSample> samples;  // the base directions, then those to targets
    std::vector<TracedRay> rays;           // of the samples, with -Sd only
    std::vector<Radiance> guesses;         // of the samples; empty: nothing is guessed
    // kNoRegion: the sample shows an image of a light source, which has its own samples; its solid angle,
    // radiance and guess are then 0.
    std::vector<RegionId> regions;
    // The first sample of each target, or of all parts of one image; then the first that the guide has sent.
    std::vector<size_t> runs;
  };

  // The steps of sample(), in this order. Each takes values of those before it.
  PathRequest requestFor(const SetAtPoint& set, const std::optional<LocalGuess>& guess) const;
  Surroundings lookAround(const SetAtPoint& set, const Images& images, const PathsFrom& paths) const;
  LocalGuess fitGuess(const SetAtPoint& set, const Surroundings& around) const;
  // solidAngle: that all of them represent together, sr. guess: null if nothing is guessed.
  // guided: directions that the guide sends; null: none.
  Others sampleOthers(const SetAtPoint& set, const Images& images, const Targets& targets, double solidAngle,
                      const LocalGuess* guess, const DirectionGuide* guide, size_t guided,
                      const PathsFrom& paths) const;
  // Adds what glances find to the set.
  void addGlances(DiffuseGlances::Found found, const Others& others, SampledSet& sampled) const;
  // The moments of the guess by glances, minus those by the directions.
  struct Excess {
    Moments moments;
    Variance variance;  // of the glances; 0 unless standard errors are wanted
  };
  Excess excessOfGlances(const SetAtPoint& set, const Others& others, const LocalGuess& guess,
                         const DirectionGuide* guide) const;
  Variance varianceOf(const Others& others, std::span<const SeenSources::Sample> toImages) const;

  const SphereOptions& options_;
  const BaseSet& base_;
  const SeenSources& sources_;
  const DiffuseGlances* glances_;
  std::optional<Guidance> guidance_;  // none with -Sk 0
};

}  // namespace rsphere
