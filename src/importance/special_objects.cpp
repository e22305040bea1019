#include "importance/special_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rsphere {
namespace {

struct Irregularity {
  static double lobe(double share, double roughness) {
    const double wide = roughness / kSharpRoughness;
    return share / (1 + wide * wide);
  }
  double operator()(const Opaque& m) const { return lobe(m.specularity, m.roughness); }
  double operator()(const Trans& m) const {
    return lobe(std::max(m.specularity, (1 - m.specularity) * m.transmissivity * m.transmittedSpecular),
                m.roughness);
  }
  double operator()(const Dielectric&) const { return 1; }
  double operator()(const Interface&) const { return 1; }
  double operator()(const Glass&) const { return 1; }
  double operator()(const Mirror&) const { return 1; }
  double operator()(const Light&) const { return 0; }
  double operator()(const Illum&) const { return 0; }
  double operator()(const Glow&) const { return 0; }
  double operator()(const Spotlight&) const { return 0; }
};

std::string why(const Material& material, double irregularity) {
  if (const auto* m = std::get_if<Opaque>(&material))
    return fmt::format("specularity {:g}, roughness {:g}: irregularity {:.3g} of at least {:g}",
                       m->specularity, m->roughness, irregularity, kSpecialIrregularity);
  if (const auto* m = std::get_if<Trans>(&material))
    return fmt::format(
        "specularity {:g}, transmitted {:g}, roughness {:g}: irregularity {:.3g} of at least {:g}",
        m->specularity, m->transmissivity * m->transmittedSpecular, m->roughness, irregularity,
        kSpecialIrregularity);
  return "irregular by type";
}

}  // namespace

double irregularity(const Material& material) { return std::visit(Irregularity{}, material); }

std::vector<SpecialObject> findSpecialObjects(const Scene& scene, double factor) {
  std::vector<SpecialObject> objects;
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& s = scene.surfaces[i];
    if (s.material == kNone || std::holds_alternative<Distant>(s.shape)) continue;
    const double value = irregularity(scene.modifiers[s.material].content);
    if (value >= kSpecialIrregularity) objects.push_back({i, value, value * kDirectionsPerSr * factor});
  }
  return objects;
}

std::string specialObjectsText(const Scene& scene, const std::vector<SpecialObject>& objects) {
  std::string text;
  for (const SpecialObject& o : objects) {
    const Surface& s = scene.surfaces[o.surface];
    const Modifier& m = scene.modifiers[s.material];
    const rad::Primitive& p = scene.description.primitives[m.primitive];
    fmt::format_to(std::back_inserter(text), "{}\t{} \"{}\"\t{:.6g} per sr\t{}\n", scene.place(s.primitive),
                   rad::typeName(p.type), scene.description.name(p), o.density,
                   why(m.content, o.irregularity));
  }
  return text;
}

}  // namespace rsphere
