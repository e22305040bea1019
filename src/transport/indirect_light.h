#pragma once
// Indirect diffuse light: the mean radiance from the hemisphere over a surface.
//
// With -aa above 0, the light at the first diffuse surface of a path is interpolated (irradiance_field.h),
// and that of later ones comes from the coarse solution (coarse_solution.h); in sphere mode that of the
// first, too. Otherwise it is gathered: -ad + -as stratified directions at the first diffuse surface, and as
// RADIANCE at later ones.
#include "shade/scattering.h"
#include "transport/interpolated_light.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

class IndirectLight {
 public:
  // Keeps references.
  IndirectLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                RayFollower& follower, InterpolatedLight& interpolated)
      : t_(prepared), settings_(settings), state_(state), follower_(follower), interpolated_(interpolated) {}

  // Adds the light of a side to the radiance of a ray (W/sr/m2), beyond -ab bounces the ambient value (-av).
  // No light comes from behind the surface.
  void add(const RayEnd& end, const DiffuseSide& side, Radiance& value);

 private:
  int raysToGuess(const PathContext& ray) const;
  int raysOf(const PathContext& ray, const Coefficient& coefficient) const;
  void gather(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  void link(const RayEnd& end, const DiffuseSide& side);

  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
  InterpolatedLight& interpolated_;
};

}  // namespace rsphere
