#pragma once
#include <optional>
#include <span>
#include <vector>

#include "importance/base_set.h"
#include "importance/diffuse_glances.h"
#include "importance/sampling_strategy.h"
#include "importance/seen_sources.h"
#include "importance/targets.h"
#include "transport/radiance_guess.h"

namespace rsphere {

// -Sw c, the default. It differs from the paper's rule (voronoi_weights.h) as follows:
// - Light sources that are seen directly cause nearly all of the variance, so they are integrated separately
//   (seen_sources.h).
// - Cells keep to the silhouettes. The cell of a base direction is its Voronoi cell on the sphere; inside a
//   silhouette it is shared with the dynamic directions that were sent there, in proportion to their numbers.
//   The cells in a silhouette add up to its solid angle, unless others overlap it, and the cells outside all
//   silhouettes add up to the remaining solid angle (cells_in_targets.h). Plain cells reach over the
//   silhouette's edge from the dense side and bias the mean by a percent.
// - The number of directions to a special object depends on how much the radiance on it varies, compared with
//   its surroundings. Separate rays measure the variation, so that the mean stays unbiased (targets.h).
//   Openings that show daylight, and spots of sunlight that enters through them, also get directions of their
//   own.
// - Indirect rays are aimed at openings that daylight enters through (transport/openings.h), and at diffuse
//   surfaces that receive much direct light (transport/bright_spots.h).
// - In scenes with lamps, many glances and shadow rays to light vertices, instead of these directions,
//   estimate the light of plain diffuse surfaces (diffuse_glances.h).
// - In other scenes with lamps, a control variate reduces the variance of diffuse surfaces
//   (transport/radiance_guess.h). Many glances, rays that are not followed beyond their first hit, estimate
//   its integral. Directions only estimate the difference.
// With -Sk 0 only the first of these applies.
class SilhouetteWeights : public SamplingStrategy {
 public:
  // Keeps references to all of them. glances: null if they do not find all of the light of diffuse surfaces;
  // otherwise they are used instead of the guess.
  SilhouetteWeights(const SphereTracing& tracing, const SphereOptions& options, const BaseSet& base,
                    std::span<const SpecialObject> special, const SeenSources& sources,
                    const DiffuseGlances* glances);

  SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const override;

 private:
  using Images = std::vector<SeenSources::Image>;

  // Means to reduce the variance of light that does not come directly from sources.
  struct Guidance {
    TargetChoice targets;
    RadianceGuess guess;
    std::vector<V3d> glances, fitGlances;  // no glances: nothing is guessed
    std::optional<Neighbours> neighbours;  // of glances, if standard errors are wanted
  };

  // Stage 1: information about the view from a point, before directions are chosen.
  struct View {
    Images images;              // of sources that are integrated separately
    double meanBrightness = 0;  // of the light that other directions find, W/sr/m2
    std::optional<LocalGuess> guess;
    DiffuseGlances::Found glanced;  // 0 where glances do not find all of the light of diffuse surfaces
  };
  View viewFrom(const SetAtPoint& set, PathTracer& tracer) const;
  // Sets meanBrightness and guess, by rays whose radiances are used for nothing else.
  void lookAround(const SetAtPoint& set, PathTracer& tracer, View& view) const;

  // Stage 2: the directions that are not sent to images of sources.
  struct Plan {
    Targets targets{std::vector<Target>()};
    // The base directions, then a run for each target or for all parts of one image.
    std::vector<V3d> directions;
    std::vector<size_t> runs;  // where each run begins, then the end of the last
    double solidAngle = 0;     // total of these directions, sr
  };
  Plan planFor(const SetAtPoint& set, const View& view, std::span<const SeenSources::Sample> toImages) const;
  // Sets directions and runs.
  void chooseDirections(const SetAtPoint& set, Plan& plan) const;

  // Stage 3: traces and weights the directions of the plan. Those that show an image of a light source, which
  // has samples of its own, are in kNoRegion; their solid angle, radiance and guess are 0.
  SampledSet traced(const SetAtPoint& set, const View& view, const Plan& plan, const PathsFrom& paths) const;
  // The part of the light along direction number i that glances estimate.
  Radiance guessAlong(const SetAtPoint& set, const View& view, size_t i, const V3d& direction,
                      const TracedRay& ray) const;

  // Stage 4: the light that glances find, minus the guesses of the directions.
  DiffuseGlances::Found beyondGuesses(const SetAtPoint& set, const View& view,
                                      std::span<const DirectionSample> others) const;
  void addGlances(const SetAtPoint& set, const LocalGuess& guess, DiffuseGlances::Found& found) const;

  // Stage 5: the variance due to both kinds of directions, but not glances. to: as in error_estimate.h.
  Variance varianceOf(std::span<const DirectionSample> others, std::span<const size_t> runs,
                      std::span<const SeenSources::Sample> toImages, ZoneVariances* to) const;

  const SphereOptions& options_;
  const BaseSet& base_;
  const SeenSources& sources_;
  const DiffuseGlances* glances_;
  std::optional<Guidance> guidance_;  // none with -Sk 0
};

}  // namespace rsphere
