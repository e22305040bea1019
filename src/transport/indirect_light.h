#pragma once
// Indirect diffuse light: the mean radiance from the hemisphere over a surface.
//
// With -aa above 0, the light at the first diffuse surface of a path is interpolated (irradiance_field.h),
// and the light at later surfaces comes from the coarse solution (coarse_solution.h); in sphere mode, so does
// the light at the first. With -aa 0, light is gathered from -ad + -as stratified directions at the first
// diffuse surface, and from as many as in RADIANCE at later ones.
#include "field/coarse_solution.h"
#include "field/irradiance_field.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

// A side of a diffuse surface at the end of a ray, where indirect light arrives.
struct DiffuseSide {
  const V3d& point;                // world
  const V3d &normal, &trueNormal;  // unit normals on this side: perturbed by textures, and the surface's own
  RayKind kind;                    // kind of the rays that are sent from here
  const Coefficient& coefficient;  // factor of the mean arriving radiance in the radiance of the ray
};

class IndirectLight {
 public:
  // Keeps references. follower: traces gathers, and the rays that the cache and the coarse solution ask for.
  IndirectLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                RayFollower& follower)
      : t_(prepared), settings_(settings), state_(state), follower_(follower) {}

  // Adds the light of a side to the radiance of a ray (W/sr/m2), or the ambient value (-av) beyond -ab
  // bounces. No light comes from behind the surface.
  void add(const RayEnd& end, const DiffuseSide& side, Radiance& value);

  // Lets the cache free memory that the path has used. To be called at the end of each primary ray.
  void endPath();

 private:
  bool addInterpolated(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  bool addFromPatch(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  Patch* patchAt(const RayEnd& end, const DiffuseSide& side);
  int raysOf(const PathContext& ray, const Coefficient& coefficient) const;
  int firstRays() const;
  void gather(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  // What rays of a gather bring: a part of it, each ray with the weight that it has among `weighedAs`.
  struct Share {
    int weighedAs;
    double part;
  };
  void send(const RayEnd& end, const DiffuseSide& side, int rays, const Share& share, Radiance& value);
  void link(const RayEnd& end, const DiffuseSide& side);

  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
  FieldReader reader_;
  bool looksOnly_ = false;  // rays of the first gather do not go on beyond diffuse surfaces (-Sh)
};

}  // namespace rsphere
