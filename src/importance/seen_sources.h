#pragma once
// Light sources as they are seen directly from a point: few, small, bright, and known, so that they are
// integrated by themselves rather than left to chance. All directions fall in two classes: those in which
// such a source shows, directly or straight through panes, and the rest. This samples the first class; others
// leave it out.
#include <vector>

#include "importance/direction_sample.h"
#include "transport/path_tracer.h"

namespace rsphere {

class SeenSources {
 public:
  // Chooses the sources that are integrated apart: all that a view shows as sources (not illum), but for
  // distant ones wider than kWidestDistant and polygons that are not convex, whose sampling would not be
  // even. Keeps a reference to transport.
  explicit SeenSources(const Transport& transport);

  bool any() const { return any_; }

  // Whether the last primary ray of the tracer showed a source that is integrated apart.
  bool shown(const PathTracer& tracer) const {
    return tracer.shownSource() != kNone && apart_[tracer.shownSource()];
  }

  // One traced direction to a source.
  struct Sample {
    DirectionSample direction;  // solidAngle 0 where something hides the source
    double part = 0;            // what it would be if nothing did, sr
    Ray ray;
    uint32_t source = 0;  // index in LightSources
  };

  // Directions to the sources, each with the solid angle it stands for and the radiance along it. Split as
  // -ds says, but into no more than about `most` in all. Where a source is seen whole its solid angles sum to
  // its exact one (plane and round sources). Unbiased up to the ratio of two sums over a source's own parts,
  // which is 1 within a percent.
  void sample(const V3d& point, size_t most, uint64_t seed, PathTracer& tracer,
              std::vector<Sample>& samples) const;

 private:
  const Transport& transport_;
  std::vector<bool> apart_;  // by index in LightSources
  bool any_ = false;
};

// Half angle (radians) up to which a distant source is integrated apart: 6 degrees, a sun and its halo; one
// ray is all that it gets.
inline constexpr double kWidestDistant = .1;

}  // namespace rsphere
