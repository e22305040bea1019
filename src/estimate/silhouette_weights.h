#pragma once
#include <optional>
#include <span>
#include <vector>

#include "glances/diffuse_glances.h"
#include "points/base_set.h"
#include "points/sampling_strategy.h"
#include "silhouettes/seen_sources.h"
#include "targets/targets.h"

namespace rsphere {

// -Sw c, the default. It differs from the paper's rule (voronoi_weights.h) as follows:
// - Light sources that are seen directly cause nearly all of the variance, so they are integrated separately
//   (seen_sources.h).
// - Cells end at silhouettes. A base direction has its Voronoi cell on the sphere. Inside a silhouette, it
//   shares this cell with the dynamic directions sent there, in proportion to their numbers. The cells in a
//   silhouette add up to its solid angle, unless it overlaps others, and the cells outside all silhouettes
//   add up to the remaining solid angle (cells_in_targets.h). Plain Voronoi cells would extend across the
//   silhouette's edge from the dense side, which biases the mean by a percent.
// - The number of directions to a special object depends on how much its radiance varies, compared with its
//   surroundings. Separate rays measure the variation, so that the mean stays unbiased (targets.h). Openings
//   that show daylight, and spots of sunlight that enters through them, also get directions.
// - Indirect rays are aimed at openings that daylight enters through (openings/openings.h), and at diffuse
//   surfaces that receive much direct light (spots/bright_spots.h).
// - In scenes with lamps, and in rooms with openings by daylight, the light of plain diffuse surfaces is
//   estimated by glances and by shadow rays to light vertices instead of these directions
//   (diffuse_glances.h).
// With -Sk 0 only the first difference applies.
class SilhouetteWeights : public SamplingStrategy {
 public:
  // Keeps references to all of them. glances: null if traced directions find all light.
  SilhouetteWeights(const SphereTracing& tracing, const SphereOptions& options, const BaseSet& base,
                    std::span<const SpecialObject> special, const SeenSources& sources,
                    const DiffuseGlances* glances);

  SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const override;

 private:
  using Images = std::vector<SeenSources::Image>;

  // Stage 1: information about the view from a point, before directions are chosen.
  struct View {
    Images images;                  // of sources that are integrated separately
    double meanBrightness = 0;      // of light found by the other directions, W/sr/m2
    DiffuseGlances::Found glanced;  // 0 without glances
  };
  View viewFrom(const SetAtPoint& set, PathTracer& tracer) const;
  // The mean brightness around a point. No estimate uses its rays, so that estimates stay unbiased.
  double lookAround(const SetAtPoint& set, PathTracer& tracer, const Images& images) const;

  // Stage 2: the directions that are not sent to images of sources.
  struct Plan {
    Targets targets{std::vector<Target>()};
    // The base directions, then one run of directions for each target, or for all parts of one image.
    std::vector<V3d> directions;
    struct Run {
      size_t first, end = first;          // indices of its directions
      std::optional<Imath::V2d> shift{};  // of evenly(); empty for several parts of an image
    };
    std::vector<Run> runs;
    std::vector<double> apart;  // solid angle of the images of sources, as for cellsInTargets()
  };
  Plan planFor(const SetAtPoint& set, const View& view, std::span<const SeenSources::Sample> toImages) const;
  // Sets directions and runs.
  void chooseDirections(const SetAtPoint& set, Plan& plan) const;

  // Stage 3: traces and weights the directions of the plan. Directions that show a separately sampled image
  // of a light source are in kNoRegion, with solid angle and radiance 0.
  SampledSet traced(const SetAtPoint& set, const View& view, const Plan& plan, const PathsFrom& paths) const;

  // Stage 4: SampledSet::excess.
  Moments glancedBeside(const View& view, std::span<const DirectionSample> others) const;

  // Stage 5: the variance due to directions of both kinds, without the variance of glances. to: see
  // error_estimate.h.
  Variance varianceOf(std::span<const DirectionSample> others, std::span<const Plan::Run> runs,
                      std::span<const SeenSources::Sample> toImages, KernelVariances* to) const;

  const SphereOptions& options_;
  const BaseSet& base_;
  const SeenSources& sources_;
  const DiffuseGlances* glances_;
  std::optional<TargetChoice> targets_;  // none with -Sk 0
};

}  // namespace rsphere
