#pragma once
// How a surface scatters light towards a ray's origin, in the terms in which a path tracer estimates it:
//
//   sharp paths  +  lobes, by samples  +  on each side: indirect light  +  direct light
//
// One class for each model of scattering; all have the members of the concept ScattersLight. They are values:
// they trace nothing, and take the random numbers that they need from the caller. Their terms must be
// estimated in the order above, the reflected before the transmitted, because a lobe that is too weak to be
// sampled may add its share to the indirect light.
#include <concepts>
#include <optional>

#include "scene/random.h"
#include "shade/anisotropic.h"
#include "shade/function_reflection.h"
#include "shade/material_hit.h"

namespace rsphere {

enum class Component : uint8_t { reflected, transmitted };

// Adding it to a point changes no bit of the point: -0 + -0 is -0.
inline const V3d kNoOffset{-0., -0., -0.};

// A lobe that is estimated by samples.
struct Lobe {
  int leastSamples = 1;  // of a ray of weight 1, whatever -ss is
  // Of the lobe's light in the ray's radiance. If above 0, no more samples are taken than leave each a weight
  // of at least -lw.
  double share = 0;
  V3d offset = kNoOffset;  // from the hit to the origin of the samples (world units)
};

struct LobeSample {
  V3d direction{0, 0, 0};    // unit
  Rgb coefficient{0, 0, 0};  // of its radiance in that of the ray; black: the draw gave no valid direction
};

// One side of the surface, from which light is scattered diffusely.
struct LitSide {
  V3d normal{0, 0, 1}, trueNormal{0, 0, 1};  // towards that side, unit: perturbed, and of the surface
  Rgb indirect{0, 0, 0};                     // coefficient of the mean radiance over its hemisphere
  V3d offset = kNoOffset;  // from the hit to the point that the light arrives at (world units)
  // Whether direct light is estimated at this point, after the indirect light. It is that of this side, or of
  // both sides where the same point serves both; coefficient() is 0 for the rest.
  bool direct = false;
  V3d front{0, 0, 0};  // the normal behind which coefficients of direct light are 0; 0: none
  bool even = false;   // the scattered light has no strong peak
};

// What all models of scattering answer.
template <class S>
concept ScattersLight = requires(S s, const S& c, Component component, Random& random, V3d v) {
  { c.sharp() } -> std::same_as<const SharpPaths&>;
  // Empty if the component has no lobe that is sampled.
  { s.lobe(component, random) } -> std::same_as<std::optional<Lobe>>;
  // Sample i of n of a lobe, for i from 0 on. The coefficients of all n add up to the lobe's share of light.
  { c.draw(component, 0, 1, random) } -> std::same_as<LobeSample>;
  { c.side(component) } -> std::same_as<LitSide>;
  // The share of a source's radiance that is scattered towards the ray's origin, for a source that fills a
  // solid angle (sr) in a direction (unit). component: that of a side whose LitSide::direct is set.
  { c.coefficient(component, v, 1., random) } -> std::same_as<Rgb>;
};

// plastic, metal, trans: lobes that are the same all round (scattering.h).
class RoundScattering {
 public:
  template <class M>
  RoundScattering(const M& material, const Interaction& at, const MaterialOptions& options)
      : at_(at),
        scattering_(scatter(material, at, options.specularThreshold)),
        spread_(options.specularSampling),
        sourceJitter_(options.directJitter) {}

  const SharpPaths& sharp() const { return scattering_.sharp; }
  std::optional<Lobe> lobe(Component component, Random& random) const;
  LobeSample draw(Component component, int i, int n, Random& random) const;
  LitSide side(Component component) const;
  Rgb coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, at_, toSource, solidAngle, sourceJitter_);
  }

 private:
  Interaction at_;
  Scattering scattering_;
  double spread_, sourceJitter_;
};

// plastic2, metal2, trans2, WGMDfunc: elliptic lobes (anisotropic.h).
class EllipticScattering {
 public:
  EllipticScattering(const AnisotropicScattering& scattering, const Interaction& at,
                     const MaterialOptions& options)
      : at_(at),
        scattering_(scattering),
        spread_(options.specularSampling),
        sourceJitter_(options.directJitter) {}

  const SharpPaths& sharp() const { return scattering_.sharp; }
  std::optional<Lobe> lobe(Component component, Random& random) const;
  LobeSample draw(Component component, int i, int n, Random& random) const;
  LitSide side(Component component) const;
  Rgb coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, at_.direction, toSource, solidAngle, sourceJitter_);
  }

 private:
  Interaction at_;
  AnisotropicScattering scattering_;
  double spread_, sourceJitter_;
};

// ashik2 (anisotropic.h).
class AshikhminLobeScattering {
 public:
  AshikhminLobeScattering(const AshikhminScattering& scattering, const Interaction& at)
      : at_(at), scattering_(scattering) {}

  const SharpPaths& sharp() const { return sharp_; }
  std::optional<Lobe> lobe(Component component, Random& random) const;
  LobeSample draw(Component component, int i, int n, Random& random) const;
  LitSide side(Component component) const;
  Rgb coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, at_.direction, toSource, solidAngle);
  }

 private:
  Interaction at_;
  AshikhminScattering scattering_;
  SharpPaths sharp_;  // none
};

// plasfunc and the like, BRTDfunc: functions give the scattering of direct light (function_reflection.h).
class ProgrammedScattering {
 public:
  // Keeps references to the functions and to the scratch memory. material: index in Scene::modifiers.
  ProgrammedScattering(const FunctionScattering& scattering, const Interaction& at,
                       const FunctionPoint& point, const SurfaceFunctions& functions,
                       FunctionScratch& scratch, ModifierId material)
      : at_(at),
        scattering_(scattering),
        point_(point),
        functions_(&functions),
        scratch_(&scratch),
        material_(material) {}

  const SharpPaths& sharp() const { return scattering_.sharp; }
  std::optional<Lobe> lobe(Component, Random&) const { return {}; }
  LobeSample draw(Component, int, int, Random&) const { return {}; }
  LitSide side(Component component) const;
  Rgb coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, toSource, solidAngle, [&] {
      return functions_->distribution(material_, point_, toSource, solidAngle, *scratch_);
    });
  }

 private:
  Interaction at_;
  FunctionScattering scattering_;
  FunctionPoint point_;
  const SurfaceFunctions* functions_;
  FunctionScratch* scratch_;
  ModifierId material_;
};

}  // namespace rsphere
