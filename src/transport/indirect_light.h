#pragma once
// Indirect diffuse light: the mean radiance from the hemisphere over a surface.
//
// With -aa above 0, the light at the first diffuse surface of a path is interpolated (irradiance_field.h),
// and that of later ones comes from the coarse solution (coarse_solution.h); in sphere mode that of the first, too.
// Otherwise it is gathered: -ad + -as stratified directions at the first diffuse surface, and as RADIANCE at later ones.
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

  // Adds coefficient times the mean radiance over the hemisphere around the normal (unit, perturbed by
  // textures) to the ray's value (W/sr/m2), or times the ambient value (-av) beyond -ab bounces. trueNormal:
  // of the surface, on the same side; no light comes from behind it.
  void add(Ray& ray, const V3d& normal, const V3d& trueNormal, RayKind kind, const Coefficient& coefficient);

 private:
  // A side of a diffuse surface.
  struct Side {
    V3d normal, trueNormal;
    RayKind kind;
    Coefficient coefficient;
  };

  int raysToGuess(const Ray& ray) const;
  int raysOf(const Ray& ray, const Coefficient& coefficient) const;
  void gather(Ray& ray, const Side& at);
  void link(const Ray& ray, const Side& at);

  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
  InterpolatedLight& interpolated_;
};

}  // namespace rsphere
