#pragma once
// Light from sharp reflection and refraction, and from glossy lobes by sampling.
#include "shade/material_response.h"
#include "transport/function_ref.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

// Draws sample i of n of a lobe.
using LobeSampler = FunctionRef<LobeSample(int i, int n)>;

// The part of a source's light that is left to samples of the lobe, for a sample that has hit the source
// (shared_highlights.h).
using LobeShare = FunctionRef<Radiance(const RayEnd& sample)>;

class SpecularLight {
 public:
  // Keeps references.
  SpecularLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                RayFollower& follower)
      : t_(prepared), settings_(settings), state_(state), follower_(follower) {}

  // Each adds light to the result of a ray (W/sr/m2): that of sharp paths from its end; that of the rays that
  // a prism redirects; and, for a shadow ray that has reached a virtual source, that of the source which it
  // relays.
  void add(const RayEnd& end, const SharpPaths& sharp, RayResult& result);
  void add(const RayEnd& end, const ReflectsSharply& response, RayResult& result) {
    add(end, response.scattering.sharp, result);
  }
  void add(const RayEnd& end, const Redirects& redirects, RayResult& result);
  void add(const RayEnd& end, const Relays& relays, RayResult& result);

  // The light of one lobe, estimated by samples. kind: of their rays. share: see LobeShare; null: none.
  void addLobe(const RayEnd& end, RayKind kind, const Lobe& lobe, LobeSampler draw, const LobeShare* share,
               RayResult& result);

 private:
  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
};

}  // namespace rsphere
