#pragma once
// Shading of the surface that a ray hit: processes its chain of modifiers down to a material, including
// mixtures, and adds up the light that the material's response calls for (shade/material_response.h).
#include "transport/outgoing_light.h"

namespace rsphere {

class SurfaceShading : PathPart {
 public:
  explicit SurfaceShading(const PathPart& path);

  // The light of the materials.
  OutgoingLight& light() { return light_; }

  // Computes the radiance (W/sr/m2) at the end of a ray that hit a surface, and the mirrored part of it.
  // False, without any effect, if the ray passes the surface because antimatter cuts it away or because it
  // has no material.
  bool shade(RayEnd& end, RayResult& result);

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
  bool estimate(RayEnd& end, const Emits& emits, RayResult& result) {
    light_.addEmitted(end, emits, result);
    return true;
  }
  bool estimate(RayEnd& end, const Boundary& boundary, RayResult& result);
  template <OneOf<ReflectsSharply, Redirects, Relays> Sharp>
  bool estimate(RayEnd& end, const Sharp& sharp, RayResult& result) {
    light_.specular.add(end, sharp, result);
    return true;
  }
  bool estimate(RayEnd& end, const CrossesMist& boundary, RayResult& result);
  bool estimate(RayEnd& end, const CrossesAntimatter& boundary, RayResult& result);
  template <ScattersLight S>
  bool estimate(RayEnd& end, S& scattering, RayResult& result) {
    light_.addScattered(end, scattering, result);
    return true;
  }

  OutgoingLight light_;
  MaterialContext context_;
};

}  // namespace rsphere
