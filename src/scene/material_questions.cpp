#include "scene/material_questions.h"

#include <cmath>

#include "base/overloaded.h"

namespace rsphere {

// The materials of light sources, and all others. A new type belongs to one of these.
template <class M>
concept SourceMaterial = OneOf<M, Light, Illum, Glow, Spotlight>;
template <class M>
concept DarkMaterial =
    OneOf<M, Opaque, Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction, WgmdFunction,
          BsdfMaterial, Dielectric, Interface, Glass, Mirror, Prism, Antimatter, Mist>;

bool isTransparent(const Material& material) {
  return match(
      material, [](const OneOf<Trans, Dielectric, Interface, Glass, Mist> auto&) { return true; },
      [](const Anisotropic& m) { return m.trans; },
      [](const OneOf<BrtdFunction, WgmdFunction> auto& m) { return m.transmits; },
      [](const BsdfMaterial& m) { return m.aperture || m.proxy; },
      [](const OneOf<Opaque, Ashikhmin, FunctionScatterer, Mirror, Prism, Antimatter> auto&) {
        return false;
      },
      [](const SourceMaterial auto&) { return false; });
}

Sides stopsShadows(const Material& material) {
  return match(
      material,
      [](const Opaque&) {
        return Sides{true, false};
      },
      [](const Mirror& m) {
        return Sides{m.alternate.kind == Alternate::Kind::none, false};
      },
      [](const OneOf<BrtdFunction, WgmdFunction> auto& m) {
        return Sides{!m.transmits, !m.transmits};
      },
      [](const OneOf<Anisotropic, Ashikhmin, FunctionScatterer, Prism, Light, Glow, Spotlight> auto&) {
        return Sides{true, true};
      },
      [](const OneOf<Trans, Dielectric, Interface, Glass, BsdfMaterial, Antimatter, Mist, Illum> auto&) {
        return Sides{};
      });
}

bool isBoundary(const Material& material) {
  return match(
      material, [](const OneOf<Dielectric, Interface> auto&) { return true; },
      [](const OneOf<Opaque, Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction, WgmdFunction,
                     BsdfMaterial, Glass, Mirror, Prism, Antimatter, Mist> auto&) { return false; },
      [](const SourceMaterial auto&) { return false; });
}

bool enclosesVolume(const Material& material) {
  return match(
      material, [](const OneOf<Antimatter, Mist> auto&) { return true; },
      [](const OneOf<Opaque, Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction, WgmdFunction,
                     BsdfMaterial, Dielectric, Interface, Glass, Mirror, Prism> auto&) { return false; },
      [](const SourceMaterial auto&) { return false; });
}

std::optional<Alternate> alternateOf(const Material& material) {
  using Answer = std::optional<Alternate>;
  return match(
      material, [](const OneOf<Mirror, Illum> auto& m) -> Answer { return m.alternate; },
      [](const Antimatter& m) -> Answer { return m.cut; },
      [](const OneOf<Opaque, Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction, WgmdFunction,
                     BsdfMaterial, Dielectric, Interface, Glass, Prism, Mist> auto&) -> Answer { return {}; },
      [](const OneOf<Light, Glow, Spotlight> auto&) -> Answer { return {}; });
}

std::optional<Radiance> sourceRadiance(const Material& material) {
  using Answer = std::optional<Radiance>;
  return match(
      material, [](const SourceMaterial auto& m) -> Answer { return Radiance(m.radiance); },
      [](const DarkMaterial auto&) -> Answer { return {}; });
}

bool isLightSource(const Material& material) { return sourceRadiance(material).has_value(); }

bool isSampled(const Material& material) {
  const auto emits = [](const auto& source) { return !(maxChannel(source.radiance) <= 0); };
  return match(
      material, [&](const OneOf<Light, Illum, Spotlight> auto& m) { return emits(m); },
      [&](const Glow& m) { return emits(m) && !(m.reach <= 0); },
      [](const DarkMaterial auto&) { return false; });
}

double reachOf(const Material& material) {
  return match(
      material, [](const Glow& m) { return m.reach; },
      [](const OneOf<Light, Illum, Spotlight> auto&) { return 0.; },
      [](const DarkMaterial auto&) { return 0.; });
}

Cover coverOf(const Material& material) {
  return match(
      material, [](const Glow&) { return Cover::yields; },
      [](const Illum& m) {
        return m.alternate.kind == Alternate::Kind::modifier ? Cover::hides : Cover::passes;
      },
      [](const OneOf<Light, Spotlight> auto&) { return Cover::hides; },
      [](const DarkMaterial auto&) { return Cover::hides; });
}

int imagesMadeBy(const Material& material) {
  return match(
      material, [](const Mirror&) { return 1; }, [](const Prism& m) { return m.images; },
      [](const OneOf<Opaque, Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction, WgmdFunction,
                     BsdfMaterial, Dielectric, Interface, Glass, Antimatter, Mist> auto&) { return 0; },
      [](const SourceMaterial auto&) { return 0; });
}

std::optional<MirrorReflection> mirrorReflection(const Material& material) {
  using Answer = std::optional<MirrorReflection>;
  return match(
      material,
      [](const Opaque& m) -> Answer {
        return MirrorReflection{.share = m.specularity,
                                .brightness = m.specularity * (m.metal ? brightness(m.color) : 1),
                                .roughness = m.roughness};
      },
      [](const Trans& m) -> Answer {
        return MirrorReflection{
            .share = m.specularity, .brightness = m.specularity, .roughness = m.roughness};
      },
      [](const Mirror& m) -> Answer {
        return MirrorReflection{
            .share = maxChannel(m.reflectance), .brightness = brightness(m.reflectance), .frontOnly = true};
      },
      [](const Glass&) -> Answer { return MirrorReflection{.boundaries = 2}; },
      [](const OneOf<Dielectric, Interface> auto&) -> Answer { return MirrorReflection{.boundaries = 1}; },
      [](const OneOf<Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction, WgmdFunction, BsdfMaterial,
                     Prism, Antimatter, Mist> auto&) -> Answer { return {}; },
      [](const SourceMaterial auto&) -> Answer { return {}; });
}

std::optional<DiffuseReflection> diffuseReflection(const Material& material) {
  using Answer = std::optional<DiffuseReflection>;
  return match(
      material,
      [](const Opaque& m) {
        return Answer({m.color, 1 - m.specularity});
      },
      [](const OneOf<Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction, WgmdFunction,
                     BsdfMaterial, Dielectric, Interface, Glass, Mirror, Prism, Antimatter, Mist> auto&)
          -> Answer { return {}; },
      [](const SourceMaterial auto&) -> Answer { return {}; });
}

namespace {

// The transmissivity (of a single passage) at which a pane transmits all light at normal incidence, including
// interreflection between its two sides. It solves (1-r)^2 t / (1 - r^2 t^2) = 1, with Fresnel's reflectance
// r of one side: 1.089 for the usual glass, and 1 for a refractive index of 1.
double mostTransmissivity(double refraction) {
  const double r = std::pow((refraction - 1) / (refraction + 1), 2);
  const double passed = (1 - r) * (1 - r);
  return 2 / (passed + std::sqrt(passed * passed + 4 * r * r));
}

std::optional<Excess> firstAbove(std::initializer_list<Excess> arguments) {
  for (const Excess& a : arguments)
    if (a.value > a.most + kRoundedArgument) return a;
  return {};
}

Excess reflectance(const Color& c) { return {"reflectance", maxChannel(c)}; }
Excess transmissivity(const Color& c) { return {"transmissivity", maxChannel(c)}; }

}  // namespace

std::optional<Excess> excessOf(const Material& material) {
  using Answer = std::optional<Excess>;
  return match(
      material,
      [](const Opaque& m) {
        return firstAbove({reflectance(m.color), {"specularity", m.specularity}});
      },
      [](const OneOf<Trans, Anisotropic, FunctionScatterer> auto& m) -> Answer {
        return firstAbove(
            {reflectance(m.color), {"specularity", m.specularity}, {"transmissivity", m.transmissivity}});
      },
      [](const Ashikhmin& m) {
        return firstAbove({reflectance(m.diffuse), reflectance(m.specular)});
      },
      [](const OneOf<BrtdFunction, WgmdFunction, BsdfMaterial> auto& m) -> Answer {
        return firstAbove(
            {reflectance(m.diffuseFront), reflectance(m.diffuseBack), transmissivity(m.diffuseTransmitted)});
      },
      [](const Dielectric& m) -> Answer { return firstAbove({transmissivity(m.transmission)}); },
      [](const Interface& m) -> Answer {
        return firstAbove({transmissivity(m.innerTransmission), transmissivity(m.outerTransmission)});
      },
      [](const Glass& m) -> Answer {
        return firstAbove(
            {{"transmissivity", maxChannel(m.transmissivity), mostTransmissivity(m.refraction)}});
      },
      [](const Mirror& m) -> Answer { return firstAbove({reflectance(m.reflectance)}); },
      [](const OneOf<Prism, Antimatter, Mist> auto&) -> Answer { return {}; },
      [](const SourceMaterial auto&) -> Answer { return {}; });
}

}  // namespace rsphere
