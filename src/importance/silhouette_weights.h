#pragma once
#include <optional>
#include <span>
#include <vector>

#include "importance/base_set.h"
#include "importance/sampling_strategy.h"
#include "importance/seen_sources.h"
#include "importance/targets.h"
#include "transport/radiance_guess.h"

namespace rsphere {

// -Sw c, the default. It differs from the paper's rule (voronoi_weights.h) as follows:
// - Light sources that are seen directly cause nearly all of the variance, so they are integrated
//   separately (seen_sources.h).
// - Cells keep to the silhouettes. The cell of a base direction is its Voronoi cell on the sphere; inside a
//   silhouette it is shared with the dynamic directions that were sent there, in proportion to their numbers,
//   and outside it is not changed. Plain cells reach over the silhouette's edge from the dense side and bias
//   the mean by a percent.
// - How many directions a special object gets follows from how much the radiance on it varies, compared with
//   the surroundings. That is measured by separate rays, so that the mean stays unbiased (targets.h).
// - Indirect rays are aimed at diffuse surfaces that receive much direct light (transport/bright_spots.h).
// - A control variate reduces the variance of diffuse surfaces (transport/radiance_guess.h). Its integral
// comes
//   from many glances, rays that are not followed beyond their first hit. Directions, and the indirect rays
//   that they spawn, only estimate the difference.
// With -Sk 0 only the first of these is left.
class SilhouetteWeights : public SamplingStrategy {
 public:
  // Keeps references to all of them. spots: what the tracers of sample() aim indirect rays at, or null.
  SilhouetteWeights(const Transport& transport, const SphereOptions& options, const BaseSet& base,
                    std::span<const SpecialObject> special, const SeenSources& sources,
                    const BrightSpots* spots);

  // The steps, each of which passes a value on: images of light sources, a guess of diffuse radiance that is
  // fitted to what is seen around, directions to the images, targets, all other directions; from these
  // weights, what glances add, and the variance.
  SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const override;

 private:
  using Images = std::vector<SeenSources::Image>;

  // What reduces the variance of all that is not a light source; absent with -Sk 0.
  struct Guidance {
    TargetChoice targets;
    RadianceGuess guess;
    std::vector<V3d> glances, fitGlances;
  };

  // What separate rays see around a point, light sources that are integrated separately left out.
  struct Surroundings {
    std::vector<RadianceGuess::Traced> traced;
    double meanBrightness = 0;  // W/sr/m2
  };

  // The directions that are not sent to images of light sources.
  struct Others {
    std::vector<DirectionSample> samples;  // the base directions, then those to targets
    std::vector<Ray> rays;                 // of the samples, with -Sd only
    std::vector<Rgb> guesses;              // of the samples; empty: nothing is guessed
    // Whether the sample enters the mean: not where it shows an image of a light source, as the image has its
    // own samples. Then its solid angle, radiance and guess are 0.
    std::vector<bool> enters;
    // Where the samples of one target begin, or of all parts of one image; at last where the samples end.
    std::vector<size_t> runs;
    double solidAngle = 0;  // sum over all samples, sr
  };

  Surroundings lookAround(const SetAtPoint& set, const Images& images, PathTracer& tracer) const;
  LocalGuess fitGuess(const SetAtPoint& set, const Surroundings& around) const;
  Others sampleOthers(const SetAtPoint& set, const Images& images, const Targets& targets,
                      const LocalGuess* guess, PathTracer& tracer) const;
  Moments excessOfGlances(const SetAtPoint& set, const Others& others, const LocalGuess& guess) const;
  Variance varianceOf(const Others& others, std::span<const SeenSources::Sample> toImages) const;

  const SphereOptions& options_;
  const BaseSet& base_;
  const SeenSources& sources_;
  std::optional<Guidance> guidance_;
};

}  // namespace rsphere
