#pragma once
// Shading of the surface that a ray hit: its chain of modifiers down to a material, mixtures, and the light
// that the material says (shade/material_response.h) is to be followed.
#include "shade/material_response.h"
#include "transport/direct_light.h"
#include "transport/indirect_light.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"
#include "transport/specular_light.h"

namespace rsphere {

class SurfaceShading {
 public:
  // Keeps references.
  SurfaceShading(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                 RayFollower& follower, DirectLight& direct, SpecularLight& specular,
                 IndirectLight& indirect);

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
  class Hit;

  bool applyModifier(Ray& ray, ModifierId modifier);
  void applyModifiers(Ray& ray, ModifierId modifier);
  bool shadeMixture(Ray& ray, ModifierId modifier, const Mixture& mixture);

  // behind: the chain of modifiers that the material has itself.
  template <class M>
  bool shadeMaterial(Ray& ray, const M& material, ModifierId behind);

  // Sets the radiance of the ray according to the response of a material (W/sr/m2). False if the ray hit an
  // alternate without a material instead.
  template <class... Outcomes>
  bool follow(Ray& ray, std::variant<Outcomes...>& response);
  bool follow(Ray&, Absorbs) { return true; }
  bool follow(Ray& ray, Passes);
  bool follow(Ray& ray, const Alternate& alternate);
  bool follow(Ray& ray, const Emits& emits);
  bool follow(Ray& ray, const ReflectsSharply& response);
  bool follow(Ray& ray, const Boundary& boundary);
  bool follow(Ray& ray, const Redirects& redirects);
  bool follow(Ray& ray, const Relays& relays);
  bool follow(Ray& ray, const CrossesMist& boundary);
  bool follow(Ray& ray, const CrossesAntimatter& boundary);
  template <ScattersLight S>
  bool follow(Ray& ray, S& scattering);
  template <ScattersLight S>
  Radiance lobesPart(const S& scattering, const Ray& sample) const;
  template <ScattersLight S>
  Coefficient lobesCoefficient(const S& scattering, const SourceSample& sample) const;

  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
  DirectLight& direct_;
  SpecularLight& specular_;
  IndirectLight& indirect_;
  MaterialContext context_;
};

}  // namespace rsphere
