#pragma once
// Scattering of light by a surface towards a ray's origin, divided into the terms that a path tracer
// estimates:
//
//   sharp paths  +  lobes, by samples  +  on each side: indirect light  +  direct light
//
// Each model of scattering is a class with the members of the concept ScattersLight. They are values: they
// trace nothing, and the caller passes their random numbers. Their terms must be estimated in the order
// above, reflection before transmission, because a lobe that is too weak to be sampled may add its share to
// the indirect light.
#include <array>
#include <concepts>
#include <optional>
#include <span>

#include "base/random.h"
#include "shade/anisotropic.h"
#include "shade/function_reflection.h"
#include "shade/material_hit.h"

namespace rsphere {

enum class Component : uint8_t { reflected, transmitted };
inline constexpr std::array kComponents{Component::reflected, Component::transmitted};
using Components = std::span<const Component>;

// Adding it leaves a point unchanged to the last bit, even if a coordinate is -0.
inline const V3d kNoOffset{-0., -0., -0.};
// The value of front() for a surface that is lit on both sides.
inline const V3d kNoFront{0, 0, 0};

// A lobe that is estimated by samples.
struct Lobe {
  int leastSamples = 1;  // for a ray of weight 1, regardless of -ss
  // The lobe's share of the ray's radiance. If it is above 0, it limits the number of samples, so that each
  // has a weight of at least -lw.
  double share = 0;
  V3d offset = kNoOffset;  // from the hit to the origin of the samples (world units)
};

// Spread of samples over a lobe (-ss) and over a light source (-dj); 1: over the whole.
struct SampleSpread {
  double lobe = 1, source = 0;

  explicit SampleSpread(const MaterialOptions& options)
      : lobe(options.specularSampling), source(options.directJitter) {}
  // Whether samples of a lobe reproduce the light that coefficient() assigns to it.
  bool isWhole() const { return lobe >= 1 && source >= 1; }
};

struct LobeSample {
  V3d direction{0, 0, 0};   // unit
  Coefficient coefficient;  // of its radiance in the ray's radiance; black: no valid direction was drawn
};

// The members of all models of scattering.
template <class S>
concept ScattersLight = requires(S s, const S& c, Component component, Random& random, V3d v) {
  { c.sharp() } -> std::same_as<const SharpPaths&>;
  // The components of the surface, in the order of estimation; all others are black.
  { c.components() } -> std::same_as<Components>;
  // Empty if no lobe of the component is sampled.
  { s.lobe(component, random) } -> std::same_as<std::optional<Lobe>>;
  // Sample i (from 0) of n of a lobe. The coefficients of all n add up to the lobe's share of light.
  { c.draw(component, 0, 1, random) } -> std::same_as<LobeSample>;
  // The coefficient of the mean radiance over the hemisphere from which the component's light arrives: around
  // the normal, or around its opposite for transmitted light.
  { c.indirect(component) } -> std::same_as<Coefficient>;
  // The perturbed normal, and that of the surface (unit), both on the ray's side for either component.
  { c.normal(component) } -> std::same_as<const V3d&>;
  { c.trueNormal() } -> std::same_as<const V3d&>;
  // From the hit to the point where light of this component arrives (world units).
  { c.offset(component) } -> std::convertible_to<V3d>;
  // Whether direct light is estimated at that point, after the indirect light of the component. If both
  // components share the point, the estimate includes the direct light of both.
  { c.takesDirect(component) } -> std::same_as<bool>;
  // The normal behind which coefficients of direct light are 0; zero vector: none.
  { c.front() } -> std::same_as<const V3d&>;
  // The fraction of a source's radiance that is scattered towards the ray's origin, for a source that fills a
  // solid angle (sr) in a direction (unit). REQUIRES takesDirect(component).
  { c.coefficient(component, v, 1., random) } -> std::same_as<Coefficient>;
  // The pdf (per sr) of a lobe's samples in a direction (unit). 0 if the samples do not exactly reproduce the
  // light that coefficient() assigns to the lobe there.
  { c.lobeDensity(component, v) } -> std::same_as<double>;
  // The fraction of light, by channel and band, that the component's lobe scatters.
  { c.lobeShare(component) } -> std::convertible_to<Color>;
  // Whether the scattered light has no strong peak.
  { c.isEven() } -> std::same_as<bool>;
};

// The answers of most models.
class UsualScattering {
 public:
  explicit UsualScattering(const Interaction& at) : at_(at) {}

  const V3d& trueNormal() const { return at_.normal; }
  static Components components() { return kComponents; }
  static const V3d& offset(Component) { return kNoOffset; }
  static const V3d& front() { return kNoFront; }
  static double lobeDensity(Component, const V3d&) { return 0; }
  static Color lobeShare(Component) { return {}; }
  static bool isEven() { return false; }

 protected:
  Interaction at_;
};

// plastic, metal, trans: rotationally symmetric lobes (scattering.h).
class RoundScattering : public UsualScattering {
 public:
  RoundScattering(const Opaque& material, const MaterialHit& hit) : RoundScattering(material, hit, false) {}
  RoundScattering(const Trans& material, const MaterialHit& hit) : RoundScattering(material, hit, true) {
    transmits_ = !isBlack(scattering_.diffuseTransmission) || !isBlack(scattering_.specularTransmission);
  }

  const SharpPaths& sharp() const { return scattering_.sharp; }
  Components components() const { return Components(kComponents).first(mayTransmit_ ? 2 : 1); }
  std::optional<Lobe> lobe(Component component, Random&) const {
    const bool sampled =
        component == Component::reflected ? scattering_.sampleReflection : scattering_.sampleTransmission;
    return sampled ? std::optional(Lobe{}) : std::nullopt;
  }
  LobeSample draw(Component component, int i, int n, Random& random) const;
  Coefficient indirect(Component component) const {
    return Coefficient(component == Component::reflected ? scattering_.ambientReflection
                                                         : scattering_.ambientTransmission);
  }
  const V3d& normal(Component) const { return scattering_.normal; }
  bool takesDirect(Component component) const {
    return component == components().back() && (transmits_ || !isBlack(scattering_.diffuseReflection) ||
                                                !isBlack(scattering_.specularReflection));
  }
  // A surface that transmits no light is lit only from its front.
  const V3d& front() const { return transmits_ ? kNoFront : scattering_.normal; }
  Coefficient coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, at_, toSource, solidAngle, spread_.source);
  }
  double lobeDensity(Component component, const V3d& direction) const {
    return component == Component::reflected && spread_.isWhole()
               ? reflectedDensity(scattering_, at_, direction)
               : 0;
  }
  const Color& lobeShare(Component component) const {
    return component == Component::reflected ? scattering_.specularReflection
                                             : scattering_.specularTransmission;
  }
  bool isEven() const;

 private:
  template <class M>
  RoundScattering(const M& material, const MaterialHit& hit, bool mayTransmit)
      : UsualScattering(hit.interaction()),
        scattering_(scatter(material, at_, hit.options().specularThreshold)),
        mayTransmit_(mayTransmit),
        transmits_(mayTransmit),
        spread_(hit.options()) {}

  Scattering scattering_;
  bool mayTransmit_, transmits_;
  SampleSpread spread_;
};

// plastic2, metal2, trans2, WGMDfunc: elliptic lobes (anisotropic.h).
class EllipticScattering : public UsualScattering {
 public:
  // along: as for scatter(const Anisotropic&, ...). Warns once per material if a highlight is anisotropic but
  // its orientation vector defines no tangent direction.
  EllipticScattering(const Anisotropic& material, const V3d& along, const MaterialHit& hit)
      : UsualScattering(hit.interaction()),
        scattering_(scatter(material, at_, along, hit.options().specularThreshold)),
        spread_(hit.options()) {
    if (scattering_.reflected.disoriented || scattering_.transmitted.disoriented)
      hit.functions().warn(material.functions, "illegal orientation vector");
  }
  EllipticScattering(const AnisotropicScattering& scattering, const Interaction& at,
                     const MaterialOptions& options)
      : UsualScattering(at), scattering_(scattering), spread_(options) {}

  const SharpPaths& sharp() const { return scattering_.sharp; }
  std::optional<Lobe> lobe(Component component, Random&) const {
    return lobeOf(component).sampled ? std::optional(Lobe{}) : std::nullopt;
  }
  LobeSample draw(Component component, int i, int n, Random& random) const;
  Coefficient indirect(Component component) const { return Coefficient(diffuse(component).ambient); }
  const V3d& normal(Component component) const { return diffuse(component).normal; }
  bool takesDirect(Component component) const { return component == Component::transmitted; }
  Coefficient coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, at_.direction, toSource, solidAngle, spread_.source);
  }
  double lobeDensity(Component component, const V3d& direction) const {
    return component == Component::reflected && spread_.isWhole()
               ? reflectedDensity(scattering_.reflected, at_, direction)
               : 0;
  }
  const Color& lobeShare(Component component) const { return lobeOf(component).share; }

 private:
  const EllipticLobe& lobeOf(Component component) const {
    return component == Component::reflected ? scattering_.reflected : scattering_.transmitted;
  }
  const DiffuseComponent& diffuse(Component component) const {
    return component == Component::reflected ? scattering_.reflection : scattering_.transmission;
  }

  AnisotropicScattering scattering_;
  SampleSpread spread_;
};

// ashik2 (anisotropic.h).
class AshikhminLobeScattering : public UsualScattering {
 public:
  AshikhminLobeScattering(const AshikhminScattering& scattering, const Interaction& at)
      : UsualScattering(at), scattering_(scattering) {}

  const SharpPaths& sharp() const { return sharp_; }
  Components components() const { return Components(kComponents).first(1); }
  std::optional<Lobe> lobe(Component component, Random& random) const;
  LobeSample draw(Component component, int i, int n, Random& random) const;
  Coefficient indirect(Component) const { return Coefficient(scattering_.reflection.ambient); }
  const V3d& normal(Component) const { return scattering_.reflection.normal; }
  bool takesDirect(Component) const { return true; }
  Coefficient coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, at_.direction, toSource, solidAngle);
  }

 private:
  AshikhminScattering scattering_;
  SharpPaths sharp_;  // always empty
};

// plasfunc and the like, BRTDfunc: functions give the scattering of direct light (function_reflection.h).
class ProgrammedScattering : public UsualScattering {
 public:
  // Keeps references to the functions and to the scratch memory. material: index in Scene::modifiers.
  ProgrammedScattering(const FunctionScattering& scattering, const Interaction& at,
                       const FunctionPoint& point, const SurfaceFunctions& functions,
                       FunctionScratch& scratch, ModifierId material)
      : UsualScattering(at),
        scattering_(scattering),
        point_(point),
        functions_(&functions),
        scratch_(&scratch),
        material_(material) {}

  const SharpPaths& sharp() const { return scattering_.sharp; }
  std::optional<Lobe> lobe(Component, Random&) const { return {}; }
  LobeSample draw(Component, int, int, Random&) const { return {}; }
  Coefficient indirect(Component component) const {
    return Coefficient(component == Component::reflected ? scattering_.ambientReflection
                                                         : scattering_.ambientTransmission);
  }
  const V3d& normal(Component) const { return scattering_.normal; }
  bool takesDirect(Component component) const;
  Coefficient coefficient(Component, const V3d& toSource, double solidAngle, Random&) const {
    return directCoefficient(scattering_, toSource, solidAngle, [&] {
      return functions_->distribution(material_, point_, toSource, solidAngle, *scratch_);
    });
  }

 private:
  FunctionScattering scattering_;
  FunctionPoint point_;
  const SurfaceFunctions* functions_;
  FunctionScratch* scratch_;
  ModifierId material_;
};

}  // namespace rsphere
