#pragma once
// Media that absorb and scatter light along a ray (-me, -ma, -mg, mist).
#include "transport/direct_light.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_functions.h"

namespace rsphere {

class ParticipatingMedia {
 public:
  // Keeps references.
  ParticipatingMedia(const PreparedScene& prepared, PathState& state, DirectLight& direct)
      : t_(prepared), state_(state), direct_(direct) {}

  // Attenuates the ray's radiance by the medium between its origin and its hit, and adds the light that the
  // medium scatters into the ray: that of the uniform ambient value (-av) and of the sources that mist names.
  void participate(Ray& ray) {
    if (isMedium(ray.medium.extinction)) passThrough(ray);
  }

 private:
  void passThrough(Ray& ray);
  void addScattered(Ray& ray);

  const PreparedScene& t_;
  PathState& state_;
  DirectLight& direct_;
};

}  // namespace rsphere
