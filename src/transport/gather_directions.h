#pragma once
// The directions of a gather: most of them distributed by projected solid angle, the others aimed at openings
// that daylight enters through, at bright spots and at highlights on rough balls and cylinders. Each is
// weighted by the density with which all of these together choose its direction (multiple importance sampling
// with the balance heuristic).
#include <array>

#include "scene/random.h"
#include "transport/aims.h"
#include "transport/function_ref.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/proposals.h"
#include "transport/ray.h"

namespace rsphere {

class GatherDirections {
 public:
  // The directions over the hemisphere around a normal (unit) at a point (world). Those behind the surface's
  // trueNormal (unit) are left out, as if it were dark there. rays: about how many directions will be drawn.
  // Keeps references to what the aims refer to.
  GatherDirections(const Aims& aims, const V3d& point, const V3d& normal, const V3d& trueNormal, int rays);

  // Called for each direction (unit), with its share of the mean over the hemisphere.
  using Each = FunctionRef<void(const V3d& direction, double part)>;

  // Draws `count` directions, whose parts sum to 1 on average over a hemisphere that lies in front of the
  // surface. Directions behind the surface are left out, and so are those that miss the highlight at which
  // they were aimed.
  void draw(int count, Random& random, Each each) const;

 private:
  double density(const V3d& direction) const;
  double unaimed() const { return 1 - openings_.share - spots_.share - highlights_.share; }

  V3d normal_, trueNormal_;
  ShareOfMixture<Openings> openings_;
  ShareOfMixture<BrightSpots> spots_;
  ShareOfMixture<Highlights> highlights_;
};

// Called for each ray, ready to be followed. Its coefficient is the factor of its radiance in the result.
using GatherRay = FunctionRef<void(const NextRay& next)>;

// Makes a ray of each direction, from a point at the end of the root. coefficient: the factor of the mean
// radiance over the hemisphere in the result. weight: the weight of one ray, relative to the root's, for
// comparison with the weight limit (-lw). An aimed direction has no smaller weight than others, although its
// factor is smaller.
void sendOverHemisphere(const PreparedScene& prepared, const GatherDirections& directions, PathState& state,
                        const RayEnd& root, const V3d& point, RayKind kind, int rays,
                        const Coefficient& coefficient, const Coefficient& weight, GatherRay each);

}  // namespace rsphere
