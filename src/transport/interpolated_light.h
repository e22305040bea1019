#pragma once
// Indirect light from the irradiance cache and from the coarse solution (-aa above 0).
#include "field/coarse_solution.h"
#include "field/irradiance_field.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/site_gatherer.h"

namespace rsphere {

class InterpolatedLight {
 public:
  // Keeps references. gatherer: traces the rays that the cache and the coarse solution ask for.
  InterpolatedLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                    SiteGatherer& gatherer)
      : t_(prepared), settings_(settings), state_(state), gatherer_(gatherer) {}

  // Adds coefficient times the interpolated mean radiance over the hemisphere around the normal (unit,
  // perturbed by textures) to the ray's value (W/sr/m2). trueNormal: of the surface. False, with nothing
  // added, if the cache cannot be used here: the light has to be gathered. REQUIRES Caches::field.
  bool add(Ray& ray, const V3d& normal, const V3d& trueNormal, const Coefficient& coefficient);

  // The same from the coarse solution. In a path from a patch (PathState::links) nothing is added to the ray;
  // a link to the patch that gives its light is recorded instead. REQUIRES Caches::coarse.
  bool addFromPatch(Ray& ray, const V3d& normal, const V3d& trueNormal, const Coefficient& coefficient);

  // Lets go of the cache's memory; to be called at the end of each primary ray.
  void endPath();

 private:
  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  SiteGatherer& gatherer_;
  FieldReader reader_;
};

}  // namespace rsphere
