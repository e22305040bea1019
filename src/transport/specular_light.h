#pragma once
// Light from sharp reflection and refraction, and from glossy lobes by sampling.
#include "shade/scattering.h"
#include "transport/function_ref.h"
#include "transport/path_state.h"
#include "transport/ray_follower.h"
#include "transport/transport.h"

namespace rsphere {

// Draws a direction (unit) of a lobe for two uniform numbers in [0, 1). Returns its weight, which is 0 if the
// draw gives no valid direction. The mean of the weights is 1.
using LobeSampler = FunctionRef<double(double u1, double u2, V3d& direction)>;

class SpecularLight {
 public:
  // Keeps references.
  SpecularLight(const Transport& transport, PathState& state, RayFollower& follower)
      : t_(transport), state_(state), follower_(follower) {}

  // Follows a ray along sharp paths, and adds their light to its value (W/sr/m2).
  void follow(Ray& ray, const SharpPaths& sharp);

  // Adds the light of the lobes of a surface that are to be sampled.
  void sampleLobes(Ray& ray, const Scattering& scattering, const Interaction& at);

  // The same for one lobe. share: of the light of the lobe in the ray's radiance. least: minimal number of
  // samples of a ray of weight 1, whatever -ss is.
  void sampleLobe(Ray& ray, RayKind kind, const Rgb& share, LobeSampler draw, int least = 1);

 private:
  const Transport& t_;
  PathState& state_;
  RayFollower& follower_;
};

}  // namespace rsphere
