#pragma once
// Indirect light from the irradiance cache and from the coarse solution (-aa above 0).
#include "field/coarse_solution.h"
#include "field/irradiance_field.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

// A side of a diffuse surface at the end of a ray, where indirect light arrives.
struct DiffuseSide {
  const V3d& point;                // world
  const V3d &normal, &trueNormal;  // unit, perturbed by textures and of the surface, both on this side
  RayKind kind;                    // of the rays that it sends
  const Coefficient& coefficient;  // of the mean radiance that arrives, in the radiance of the ray
};

class InterpolatedLight {
 public:
  // Keeps references. follower: traces the rays that the cache and the coarse solution ask for.
  InterpolatedLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                    RayFollower& follower)
      : t_(prepared), settings_(settings), state_(state), follower_(follower) {}

  // Adds the interpolated light of a side to the radiance of a ray (W/sr/m2). False, with nothing added, if
  // the cache cannot be used here: the light has to be gathered. REQUIRES Caches::field.
  bool add(const RayEnd& end, const DiffuseSide& side, Radiance& value);

  // The same from the coarse solution. REQUIRES Caches::coarse.
  bool addFromPatch(const RayEnd& end, const DiffuseSide& side, Radiance& value);

  // The patch of the coarse solution that gives the light of a side, drawn at random from those around it;
  // null if there is none. REQUIRES Caches::coarse.
  Patch* patchAt(const RayEnd& end, const DiffuseSide& side);

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
