#pragma once
// Sharp reflection and refraction, and rough highlights, which are sampled.
#include "shade/scattering.h"
#include "transport/function_ref.h"
#include "transport/path_state.h"
#include "transport/ray_follower.h"
#include "transport/transport.h"

namespace rsphere {

// Draws a direction (unit) of a lobe for two uniform numbers in [0, 1); returns its weight, 0 where the draw
// is lost. Weights have a mean of 1.
using LobeSampler = FunctionRef<double(double u1, double u2, V3d& direction)>;

class SpecularLight {
 public:
  // Keeps references.
  SpecularLight(const Transport& transport, PathState& state, RayFollower& follower)
      : t_(transport), state_(state), follower_(follower) {}

  // Follows a ray along sharp paths, and adds their light to its value (W/sr/m2).
  void follow(Ray& ray, const SharpPaths& sharp);

  // Adds the light of the highlights of a surface, if they are to be sampled.
  void sampleLobes(Ray& ray, const Scattering& scattering, const Interaction& at);

  // The same of one lobe. share: of the light of the lobe in the ray's radiance. least: the number of samples
  // that a ray of weight 1 takes whatever -ss is.
  void sampleLobe(Ray& ray, RayKind kind, const Rgb& share, LobeSampler draw, int least = 1);

 private:
  const Transport& t_;
  PathState& state_;
  RayFollower& follower_;
};

}  // namespace rsphere
