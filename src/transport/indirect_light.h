#pragma once
// Indirect diffuse light: the mean radiance from the hemisphere over a surface.
//
// With -aa above 0, the light at the first diffuse surface of a path is interpolated (irradiance_field.h),
// and that of later ones comes from the coarse solution (coarse_solution.h); in sphere mode that of the
// first, too. Otherwise it is gathered: -ad + -as stratified directions at the first diffuse surface, and as
// RADIANCE at later ones.
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

class IndirectLight {
 public:
  // Keeps references. follower: traces gathers, and the rays that the cache and the coarse solution ask for.
  IndirectLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                RayFollower& follower)
      : t_(prepared), settings_(settings), state_(state), follower_(follower) {}

  // Adds the light of a side to the radiance of a ray (W/sr/m2), beyond -ab bounces the ambient value (-av).
  // No light comes from behind the surface.
  void add(const RayEnd& end, const DiffuseSide& side, Radiance& value);

  // Lets go of the cache's memory; to be called at the end of each primary ray.
  void endPath();

 private:
  bool addInterpolated(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  bool addFromPatch(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  Patch* patchAt(const RayEnd& end, const DiffuseSide& side);
  int raysToGuess(const PathContext& ray) const;
  int raysOf(const PathContext& ray, const Coefficient& coefficient) const;
  void gather(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  void link(const RayEnd& end, const DiffuseSide& side);

  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
  FieldReader reader_;
};

}  // namespace rsphere
