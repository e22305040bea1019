#pragma once
// Light from sharp reflection and refraction, and from samples of glossy lobes.
#include "base/function_ref.h"
#include "rays/ray_follower.h"
#include "shade/material_response.h"

namespace rsphere {

// Draws sample i of n samples of a lobe.
using LobeSampler = FunctionRef<LobeSample(int i, int n)>;

// The light of the source that a lobe's sample has hit, with the weight of lobe samples
// (shared_highlights.h).
using LobeShare = FunctionRef<Radiance(const RayEnd& sample)>;

class SpecularLight : PathPart {
 public:
  explicit SpecularLight(const PathPart& path) : PathPart(path) {}

  // Each function adds light to the result of a ray (W/sr/m2): the light of sharp paths from the ray's end;
  // of rays redirected by a prism; and, for a shadow ray that has hit the relay of a virtual source, of the
  // source that the relay shows.
  void add(const RayEnd& end, const SharpPaths& sharp, RayResult& result);
  void add(const RayEnd& end, const ReflectsSharply& response, RayResult& result) {
    add(end, response.scattering.sharp, result);
  }
  void add(const RayEnd& end, const Redirects& redirects, RayResult& result);
  void add(const RayEnd& end, const Relays& relays, RayResult& result);

  // Adds the light of a lobe, estimated by samples. kind: of the samples' rays. share: see LobeShare; null:
  // none.
  void addLobe(const RayEnd& end, RayKind kind, const Lobe& lobe, LobeSampler draw, const LobeShare* share,
               RayResult& result);
};

}  // namespace rsphere
