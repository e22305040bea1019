#pragma once
// The directions of a gather. Most are distributed by projected solid angle; the others are aimed at what the
// finders of light have found (aims.h). Each is weighted by the density of the whole mixture in its direction
// (multiple importance sampling with the balance heuristic).

#include "base/function_ref.h"
#include "base/random.h"
#include "openings/light_finder.h"
#include "rays/prepared_scene.h"
#include "rays/ray.h"
#include "transport/aims.h"
#include "transport/path_state.h"

namespace rsphere {

// A lattice of directions with a random shift, or every `step`-th direction of it from `first` on.
struct DirectionSet {
  int count;  // of the whole set
  // Shifts: along the sequence, from 0 to the step between two directions, 1; of azimuths, in turns; of the
  // points of evenly().
  double sequence, azimuth, x, y;
  int first = 0, step = 1;

  DirectionSet(int count, Random& random)
      : count(count),
        sequence(random.uniform()),
        azimuth(random.uniform()),
        x(azimuth),
        y(random.uniform()) {}

  // One of kInterleavedGathers sets with equal counts, numbered from 0, that form one finer lattice. common:
  // in the same state for all of them. Each set by itself is like those of the other constructor.
  static DirectionSet interleaved(int count, int number, Random& common);
};

class GatherDirections {
 public:
  // Directions over the hemisphere around a normal (unit) at a point (world). Those that point behind the
  // surface (trueNormal: its unit normal) are left out, as if it were dark there. rays: the approximate
  // number of directions that will be drawn. Keeps references to the places of `aims`.
  GatherDirections(const Aims& aims, const V3d& point, const V3d& normal, const V3d& trueNormal, int rays);

  // Called for each direction (unit). part: its weight in the mean over the hemisphere.
  using Each = FunctionRef<void(const V3d& direction, double part)>;

  // Draws the directions of a set. The parts of a whole set sum to 1 on average if the hemisphere lies in
  // front of the surface. Leaves out directions behind the surface, and directions that miss the highlight at
  // which they were aimed.
  void draw(const DirectionSet& set, Each each) const;

 private:
  double density(const V3d& direction) const;
  double unaimed() const;

  V3d normal_, trueNormal_;
  Finders::ForEach<ShareOfMixture> shares_;
};

// Called for each ray before it is followed. The ray's coefficient is the factor on its radiance in the
// result.
using GatherRay = FunctionRef<void(const NextRay& next)>;

// Makes a ray for each direction, starting from a point at the end of the root ray. coefficient: factor on
// the mean radiance over the hemisphere in the result. weight: of one ray relative to the root, which is
// compared with the weight limit (-lw). Aimed and other directions have equal weights, although the
// coefficients of aimed directions are smaller.
void sendOverHemisphere(const PreparedScene& prepared, const GatherDirections& directions, PathState& state,
                        const RayEnd& root, const V3d& point, RayKind kind, const DirectionSet& set,
                        const Coefficient& coefficient, const Coefficient& weight, GatherRay each);

}  // namespace rsphere
