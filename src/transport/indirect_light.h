#pragma once
// Indirect diffuse light: the mean radiance from the hemisphere over a surface.
//
// With -aa above 0, the light at the first diffuse surface of a path is interpolated (irradiance_field.h),
// and the light at later surfaces comes from the coarse solution (coarse_solution.h). In sphere mode, the
// coarse solution is used at the first surface, too. At sensors (-I), light is not interpolated but gathered,
// with more rays where the gather is noisy. With -aa 0, light is gathered from -ad + -as stratified
// directions at the first diffuse surface, and from RADIANCE's number of directions at later ones.
#include "field/irradiance_field.h"
#include "rays/prepared_scene.h"
#include "rays/ray_follower.h"
#include "transport/path_state.h"

namespace rsphere {

// The side of a diffuse surface on which the indirect light arrives, at the end of a ray.
struct DiffuseSide {
  const V3d& point;                // world
  const V3d &normal, &trueNormal;  // unit normals on this side: perturbed by a texture, and geometric
  RayKind kind;                    // kind of the rays that leave from here
  const Coefficient& coefficient;  // factor on the mean arriving radiance in the radiance of the ray
};

class IndirectLight : PathPart {
 public:
  // Follows the rays of gathers, and the rays that the caches request.
  explicit IndirectLight(const PathPart& path) : PathPart(path) {}

  // Adds the indirect light of a side to the radiance of a ray (W/sr/m2); beyond -ab bounces, adds the
  // ambient value (-av). Light from behind the surface is excluded. Returns the number of rays if the light
  // was gathered here, otherwise 0.
  int add(const RayEnd& end, const DiffuseSide& side, Radiance& value);

  // Lets the cache free memory that the path has used. Call this at the end of each primary ray.
  void endPath();

 private:
  bool addInterpolated(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  bool addFromPatch(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  PatchPlace patchAt(const RayEnd& end, const DiffuseSide& side);
  int raysOf(const PathContext& ray, const Coefficient& coefficient) const;
  int firstRays() const;
  int gather(const RayEnd& end, const DiffuseSide& side, Radiance& value);
  void link(const RayEnd& end, const DiffuseSide& side);

  FieldReader reader_;
  bool looksOnly_ = false;  // rays of the first gather end at the first diffuse surface (-Sh)
};

}  // namespace rsphere
