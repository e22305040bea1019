#include "importance/special_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rsphere {
namespace {

struct Irregularity {
  static double lobe(double share, double roughness) {
    const double wide = roughness / kSharpRoughness;
    return share / (1 + wide * wide);
  }
  static double lobe(double share, double roughnessAlong, double roughnessAcross) {
    const double along = roughnessAlong / kSharpRoughness, across = roughnessAcross / kSharpRoughness;
    return share / std::sqrt((1 + along * along) * (1 + across * across));
  }
  static double lobe(const WgmdFunction::Lobe& m) {
    return lobe(std::min(m.share, 1.), m.roughnessAlong, m.roughnessAcross);
  }
  // A power of cosines as Gaussian of slopes: where both begin to fall alike.
  static double roughnessOf(double power) { return std::sqrt(2 / (power + 1)); }
  double operator()(const Opaque& m) const { return lobe(m.specularity, m.roughness); }
  double operator()(const Trans& m) const {
    return lobe(std::max(m.specularity, (1 - m.specularity) * m.transmissivity * m.transmittedSpecular),
                m.roughness);
  }
  double operator()(const Anisotropic& m) const {
    return lobe(std::max(m.specularity, (1 - m.specularity) * m.transmissivity * m.transmittedSpecular),
                m.roughnessAlong, m.roughnessAcross);
  }
  double operator()(const Ashikhmin& m) const {
    return lobe(maxChannel(m.specular), roughnessOf(m.powerAlong), roughnessOf(m.powerAcross));
  }
  double operator()(const FunctionScatterer& m) const {
    return lobe(std::max(m.specularity, (1 - m.specularity) * m.transmissivity * m.transmittedSpecular),
                kSharpRoughness);
  }
  double operator()(const BrtdFunction& m) const {
    const double sharp = std::clamp(std::max(m.mostReflected, m.mostTransmitted), 0., 1.);
    return m.directional ? std::max(sharp, lobe(1, kSharpRoughness)) : sharp;
  }
  double operator()(const WgmdFunction& m) const { return std::max(lobe(m.reflected), lobe(m.transmitted)); }
  double operator()(const BsdfMaterial& m) const { return m.aperture ? 1 : 0; }
  double operator()(const Dielectric&) const { return 1; }
  double operator()(const Interface&) const { return 1; }
  double operator()(const Glass&) const { return 1; }
  double operator()(const Mirror&) const { return 1; }
  double operator()(const Light&) const { return 0; }
  double operator()(const Illum&) const { return 0; }
  double operator()(const Glow&) const { return 0; }
  double operator()(const Spotlight&) const { return 0; }
};

// The most irregular material that a surface may show, through the mixtures of its modifiers.
struct Shown {
  const Modifier* modifier = nullptr;
  double irregularity = 0;
};
Shown mostIrregular(const Scene& scene, int32_t modifier) {
  Shown most;
  for (; modifier != kNone; modifier = scene.modifiers[modifier].next) {
    const Modifier& m = scene.modifiers[modifier];
    Shown here;
    if (const auto* material = std::get_if<Material>(&m.content)) {
      here = {&m, irregularity(*material)};
    } else if (const auto* mixture = std::get_if<Mixture>(&m.content)) {
      here = mostIrregular(scene, mixture->foreground);
      const Shown background = mostIrregular(scene, mixture->background);
      if (background.irregularity > here.irregularity) here = background;
    }
    if (here.irregularity > most.irregularity) most = here;
    if (std::holds_alternative<Material>(m.content)) break;
  }
  return most;
}

std::string why(const Material& material, double irregularity) {
  const auto reason = [&](const std::string& given) {
    return fmt::format("{}: irregularity {:.3g} of at least {:g}", given, irregularity, kSpecialIrregularity);
  };
  if (const auto* m = std::get_if<Opaque>(&material))
    return reason(fmt::format("specularity {:g}, roughness {:g}", m->specularity, m->roughness));
  if (const auto* m = std::get_if<Trans>(&material))
    return reason(fmt::format("specularity {:g}, transmitted {:g}, roughness {:g}", m->specularity,
                              m->transmissivity * m->transmittedSpecular, m->roughness));
  if (const auto* m = std::get_if<Anisotropic>(&material))
    return reason(fmt::format("specularity {:g}, transmitted {:g}, roughness {:g} and {:g}", m->specularity,
                              m->transmissivity * m->transmittedSpecular, m->roughnessAlong,
                              m->roughnessAcross));
  if (const auto* m = std::get_if<Ashikhmin>(&material))
    return reason(fmt::format("specularity {:g}, powers {:g} and {:g}", maxChannel(m->specular),
                              m->powerAlong, m->powerAcross));
  if (const auto* m = std::get_if<FunctionScatterer>(&material))
    return reason(fmt::format("specularity {:g}, transmitted {:g}, by functions", m->specularity,
                              m->transmissivity * m->transmittedSpecular));
  if (std::holds_alternative<BrtdFunction>(material) || std::holds_alternative<WgmdFunction>(material))
    return reason("by functions");
  return "irregular by type";
}

}  // namespace

double irregularity(const Material& material) { return std::visit(Irregularity{}, material); }

std::vector<SpecialObject> findSpecialObjects(const Scene& scene, double factor) {
  std::vector<SpecialObject> objects;
  for (uint32_t i = 0; i < scene.outermost().size(); ++i) {
    const Surface& s = scene.surfaces[i];
    if (std::holds_alternative<Distant>(s.shape)) continue;
    const double value = mostIrregular(scene, s.modifier).irregularity;
    if (value >= kSpecialIrregularity) objects.push_back({i, value, value * kDirectionsPerSr * factor});
  }
  return objects;
}

std::string specialObjectsText(const Scene& scene, const std::vector<SpecialObject>& objects) {
  std::string text;
  for (const SpecialObject& o : objects) {
    const Surface& s = scene.surfaces[o.surface];
    const Modifier& m = *mostIrregular(scene, s.modifier).modifier;
    const rad::Primitive& p = scene.description.primitives[m.primitive];
    fmt::format_to(std::back_inserter(text), "{}\t{} \"{}\"\t{:.6g} per sr\t{}\n", scene.place(s.primitive),
                   rad::typeName(p.type), scene.description.name(p), o.density,
                   why(std::get<Material>(m.content), o.irregularity));
  }
  return text;
}

}  // namespace rsphere
