#pragma once
// Media that absorb and scatter light along a ray (-me, -ma, -mg, and the material mist).
#include "rays/prepared_scene.h"
#include "rays/ray_functions.h"
#include "transport/direct_light.h"
#include "transport/path_state.h"

namespace rsphere {

class ParticipatingMedia {
 public:
  // Keeps references.
  ParticipatingMedia(const PreparedScene& prepared, PathState& state, DirectLight& direct)
      : t_(prepared), state_(state), direct_(direct) {}

  // Attenuates the radiance at the end of a ray by the medium along the ray, and adds the light that the
  // medium scatters into the ray. Only two kinds of light are scattered: the uniform ambient value (-av), and
  // light from the sources that mist names.
  void participate(const RayEnd& end, Radiance& value) {
    if (isMedium(end.medium().extinction)) passThrough(end, value);
  }

 private:
  void passThrough(const RayEnd& end, Radiance& value);
  void addScattered(const RayEnd& end, Radiance& value);

  const PreparedScene& t_;
  PathState& state_;
  DirectLight& direct_;
};

}  // namespace rsphere
