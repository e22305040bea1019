#pragma once
#include <vector>

#include "points/base_set.h"
#include "points/sampling_strategy.h"
#include "silhouettes/special_objects.h"

namespace rsphere {

// -Sw v, the rule of the paper (Costa, Sousa, Parracho, Cruz, "A New Technique for Spherical Radiance
// Calculation", section 4): the number of dynamic directions to a special object is its density times its
// solid angle. If there are too many in total, the objects with the fewest get none. All directions are
// weighted by their Voronoi cells.
class VoronoiWeights : public SamplingStrategy {
 public:
  // Keeps references to all of them.
  VoronoiWeights(const Scene& scene, const SphereOptions& options, const BaseSet& base,
                 const std::vector<SpecialObject>& special)
      : scene_(scene), options_(options), base_(base), special_(special), triangulation_(base.directions) {}

  SampledSet sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace& memory) const override;

 private:
  std::vector<V3d> dynamicDirections(const SetAtPoint& set) const;

  const Scene& scene_;
  const SphereOptions& options_;
  const BaseSet& base_;
  const std::vector<SpecialObject>& special_;
  BaseTriangulation triangulation_;  // of the base directions before rotation
};

}  // namespace rsphere
