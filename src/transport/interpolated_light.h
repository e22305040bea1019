#pragma once
// Indirect light from the irradiance cache and from the coarse solution (-aa above 0).
#include "field/coarse_solution.h"
#include "field/irradiance_field.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

class InterpolatedLight {
 public:
  // Keeps references. follower: traces the rays that the cache and the coarse solution ask for.
  InterpolatedLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                    RayFollower& follower)
      : t_(prepared), settings_(settings), state_(state), follower_(follower) {}

  // Adds coefficient times the interpolated mean radiance over the hemisphere around the normal (unit,
  // perturbed by textures) to the ray's value (W/sr/m2). trueNormal: of the surface. False, with nothing
  // added, if the cache cannot be used here: the light has to be gathered. REQUIRES Caches::field.
  bool add(Ray& ray, const V3d& normal, const V3d& trueNormal, const Coefficient& coefficient);

  // The same from the coarse solution. REQUIRES Caches::coarse.
  bool addFromPatch(Ray& ray, const V3d& normal, const V3d& trueNormal, const Coefficient& coefficient);

  // The patch of the coarse solution that gives the light at the ray's hit, drawn at random from those around it;
  // null if there is none. REQUIRES Caches::coarse.
  Patch* patchAt(const Ray& ray, const V3d& normal, const V3d& trueNormal);

  // Lets go of the cache's memory; to be called at the end of each primary ray.
  void endPath();

 private:
  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
  FieldReader reader_;
};

}  // namespace rsphere
