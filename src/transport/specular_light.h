#pragma once
// Light from sharp reflection and refraction, and from glossy lobes by sampling.
#include "shade/surface_scattering.h"
#include "transport/function_ref.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

// Draws sample i of n of a lobe.
using LobeSampler = FunctionRef<LobeSample(int i, int n)>;

// The light of a source that a lobe's sample has hit, as far as the lobe's samples are to estimate it
// (shared_highlights.h).
using LobeShare = FunctionRef<Radiance(const Ray& sample)>;

class SpecularLight {
 public:
  // Keeps references.
  SpecularLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                RayFollower& follower)
      : t_(prepared), settings_(settings), state_(state), follower_(follower) {}

  // Follows a ray along sharp paths, and adds their light to its value (W/sr/m2).
  void follow(Ray& ray, const SharpPaths& sharp);

  // The same for a prism's redirected rays.
  void redirect(Ray& ray, const SharpPaths& redirected);

  // Continues a shadow ray that has reached the virtual source that it was aimed at towards the source that
  // is relayed there.
  void relay(Ray& ray, const SharpPath& path);

  // Adds the light of one lobe, estimated by samples. kind: of their rays. share: see LobeShare; null: none.
  void sampleLobe(Ray& ray, RayKind kind, const Lobe& lobe, LobeSampler draw,
                  const LobeShare* share = nullptr);

 private:
  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
};

}  // namespace rsphere
