#pragma once
// Shading of the surface that a ray hit: its chain of modifiers down to a material, mixtures, and how each
// material emits, reflects and transmits light.
#include "shade/anisotropic.h"
#include "shade/function_reflection.h"
#include "transport/direct_light.h"
#include "transport/indirect_light.h"
#include "transport/path_state.h"
#include "transport/ray_follower.h"
#include "transport/specular_light.h"
#include "transport/transport.h"

namespace rsphere {

struct BsdfHit;

class SurfaceShading {
 public:
  // Keeps references.
  SurfaceShading(const Transport& transport, PathState& state, RayFollower& follower, DirectLight& direct,
                 SpecularLight& specular, IndirectLight& indirect)
      : t_(transport),
        state_(state),
        follower_(follower),
        direct_(direct),
        specular_(specular),
        indirect_(indirect) {}

  // Sets the radiance of a ray that hit a surface (W/sr/m2). The ray passes a surface that is cut away by
  // antimatter or has no material.
  void shadeHit(Ray& ray);

  // As shade(), for a surface of any kind: adds the emission of a goal. False if it has no material.
  bool shadeSurface(Ray& ray);

  // RayFollower::shade().
  bool shade(Ray& ray, ModifierId modifier);

  // Shades the ray's hit as a white diffuse surface whose radiance is the irradiance there (-i, -I).
  void meter(Ray& ray);

 private:
  bool applyModifier(Ray& ray, ModifierId modifier);
  bool shadeMixture(Ray& ray, ModifierId modifier, const Mixture& mixture);
  void applyModifiers(Ray& ray, ModifierId modifier);
  FunctionPoint functionPoint(const Ray& ray) const;
  FunctionPoint functionPoint(const Ray& ray, const FunctionScattering& scattering) const;
  FunctionPoint functionPoint(const Ray& ray, const Interaction& at) const;

  // behind: the chain of modifiers that the material has itself.
  template <class M>
  bool shadeTwoSided(Ray& ray, const M& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Opaque& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Trans& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Anisotropic& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Ashikhmin& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const FunctionScatterer& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const BrtdFunction& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const WgmdFunction& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const BsdfMaterial& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Dielectric& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Interface& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Glass& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Mirror& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Prism& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Antimatter& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Mist& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Light& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Illum& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Glow& material, ModifierId behind);
  bool shadeMaterial(Ray& ray, const Spotlight& material, ModifierId behind);

  bool countedByDirect(const Ray& ray, const Glow* glow) const;
  bool isStraight(const Ray& ray) const;
  void emit(Ray& ray, const Rgb& radiance, const Glow* glow, ModifierId behind = kNone);
  bool shadeDiffusing(Ray& ray, const Scattering& scattering, const Interaction& at);
  bool shadeBoundary(Ray& ray, const Scattering& scattering);
  bool useAlternate(Ray& ray, const Alternate& alternate);
  void sampleBsdf(Ray& ray, BsdfHit& hit, RayKind kind);
  Rgb directedBsdf(const Ray& ray, const BsdfHit& hit, const V3d& toSource, double solidAngle);
  V3d jittered(const V3d& view, double projectedSolidAngle);
  bool passesBack(Ray& ray);
  bool shadeElliptic(Ray& ray, const AnisotropicScattering& scattering, const Interaction& at);
  bool shadeByFunction(Ray& ray, const FunctionScattering& scattering, const Interaction& at,
                       ModifierId functions);
  Interaction component(const Ray& ray, const std::optional<ModifierId>& named, const Interaction& inherited);
  const LightSource* targetOf(const Ray& ray) const;
  void relay(Ray& ray, RayKind kind, const V3d& direction, Rgb coefficient);
  Interaction interaction(const Ray& ray) const;

  const Transport& t_;
  PathState& state_;
  RayFollower& follower_;
  DirectLight& direct_;
  SpecularLight& specular_;
  IndirectLight& indirect_;
  FunctionScratch scratch_;
};

}  // namespace rsphere
