#pragma once
// Shading of the surface that a ray hit: processes its chain of modifiers down to a material, including
// mixtures, and adds up the light that the material's response requires (shade/material_response.h).
#include "light_paths/owners.h"
#include "light_paths/vertex_light.h"
#include "rays/ray_follower.h"
#include "shade/material_response.h"
#include "transport/direct_light.h"
#include "transport/indirect_light.h"
#include "transport/specular_light.h"

namespace rsphere {

class SurfaceShading : PathPart {
 public:
  explicit SurfaceShading(const PathPart& path);

  DirectLight& direct() { return light_.direct; }
  IndirectLight& indirect() { return light_.indirect; }

  // Computes the radiance (W/sr/m2) at the end of a ray that hit a surface, and the mirrored part of it.
  // False, without any effect, if the ray passes the surface because antimatter cuts it away or because it
  // has no material.
  bool shade(RayEnd& end, RayResult& result);

  // Whether paths from both ends estimate all of the light along a ray, because it leaves through a portal
  // (portals.h).
  bool leftToPortals(const RayEnd& end) const;

  // Implements RayFollower::shade().
  bool shadeChain(RayEnd& end, ModifierId modifier, RayResult& result);

  // Shades the end of a ray as a white diffuse surface whose radiance is equal to the irradiance there (-i,
  // -I).
  void meter(RayEnd& end, RayResult& result);

 private:
  class Seen;

  bool applyModifier(RayEnd& end, ModifierId modifier, RayResult& result);
  void applyModifiers(RayEnd& end, ModifierId modifier);
  // The result of a mixture at the end of a ray.
  struct Mixed {
    V3d perturbation;
    Color pattern;
    std::optional<RayResult> light;  // the light of its components, if one of them is a material
  };
  // before: the result of the shading so far.
  Mixed mix(const RayEnd& end, ModifierId modifier, const Mixture& mixture, const RayResult& before);

  // behind: the modifiers that follow the material in the chain.
  template <class M>
  bool shadeMaterial(RayEnd& end, const M& material, ModifierId behind, RayResult& result);

  // Each function estimates the light of one outcome of a material's response. False, without any effect, if
  // the outcome is an alternate modifier without a material.
  bool estimate(RayEnd&, Absorbs, RayResult&) { return true; }
  bool estimate(RayEnd& end, Passes, RayResult& result);
  bool estimate(RayEnd& end, const Alternate& alternate, RayResult& result);
  bool estimate(RayEnd& end, const Emits& emits, RayResult& result);
  bool estimate(RayEnd& end, const Boundary& boundary, RayResult& result);
  template <OneOf<ReflectsSharply, Redirects, Relays> Sharp>
  bool estimate(RayEnd& end, const Sharp& sharp, RayResult& result) {
    light_.specular.add(end, sharp, result);
    return true;
  }
  bool estimate(RayEnd& end, const CrossesMist& boundary, RayResult& result);
  bool estimate(RayEnd& end, const CrossesAntimatter& boundary, RayResult& result);
  template <ScattersLight S>
  bool estimate(RayEnd& end, S& scattering, RayResult& result);
  // Who estimates the light that a surface reflects (owners.h).
  struct Owners {
    Owner ofSources = Owner::eye, highlight = Owner::eye, indirect = Owner::eye;
    // Factor on the light that is left to paths from the eye although others own the known light; 0: they are
    // not followed here.
    double rest = 1;
  };
  bool leavesThroughPortal(const RayEnd& end) const;
  Owners ownersAt(const RayEnd& end);
  double restOf(const RayEnd& end, Owner indirect);
  void addFromVertices(const RayEnd& end, const V3d& normal, const Coefficient& coefficient, Radiance& value);
  void addFromSource(const RayEnd& end, const V3d& normal, Shown shown, Radiance& value);
  template <ScattersLight S>
  bool estimateLobes(const RayEnd& end, S& scattering, bool mayShare, RayResult& result);
  template <ScattersLight S>
  void estimateSide(const RayEnd& end, S& scattering, Component side, const Owners& owners,
                    const PartOfLobe* partOfLobe, Radiance& value);
  template <ScattersLight S>
  Radiance lobesPart(const S& scattering, const RayEnd& sample) const;
  template <ScattersLight S>
  Coefficient lobesCoefficient(const S& scattering, const SourceSample& sample) const;

  struct Parts {
    DirectLight direct;
    SpecularLight specular;
    IndirectLight indirect;
  };
  Parts light_;
  MaterialContext context_;
  VertexLight::Scratch scratch_;
};

}  // namespace rsphere
