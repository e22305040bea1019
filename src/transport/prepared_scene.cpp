#include "transport/prepared_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rad_parser/printable.h"

namespace rsphere {
PreparedScene::PreparedScene(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
                             bool basicRadiance, const rad::Warn& warn)
    : PreparedScene(scene, std::make_shared<const Tracer>(scene, options.backFacesVisible), options,
                    irradiance, basicRadiance, warn) {}

PreparedScene::PreparedScene(const PreparedScene& other, const RayOptions& options)
    : PreparedScene(other.scene_, other.tracer_, options, other.irradiance_, other.basicRadiance_, {}) {}

PreparedScene::PreparedScene(const Scene& scene, std::shared_ptr<const Tracer> tracer,
                             const RayOptions& options, IrradianceAt irradiance, bool basicRadiance,
                             const rad::Warn& warn)
    : scene_(scene),
      options_(options),
      irradiance_(irradiance),
      basicRadiance_(basicRadiance),
      tracer_(std::move(tracer)),
      functions_(scene, options.sampling, warn, options.definitions, options.wavelengths),
      lights_(scene, options.directRelays, functions_, warn),
      presumedShadows_(scene, *tracer_, lights_),
      choice_(scene, lights_),
      luminous_(scene.surfaces.size()) {
  constantRadiance_.resize(lights_.all().size());
  for (const LightId i : lights_.all().ids()) {
    if (lights_.all()[i].isVirtual()) continue;
    luminous_.add(lights_.all()[i].surface);
    const Surface& surface = scene.surfaces[lights_.all()[i].surface];
    if (surface.goal ||
        (surface.modifier == surface.material && scene.modifiers[surface.material].next == kNone))
      constantRadiance_[i] = sourceRadiance(scene, surface);
  }
  for (const SurfaceId i : scene.surfaces.ids()) {
    const Surface& s = scene.surfaces[i];
    const Material* material = scene.materialOf(s);
    if (scene.importance || !s.shape.as<Distant>() || !material) continue;
    const auto radiance = sourceRadiance(*material);
    if (radiance && maxChannel(*radiance) > kNegligible) distant_.push_back(i);
  }
  findScatterers(warn);
  const bool including = !options.ambientIncluded.empty();
  const auto& names = including ? options.ambientIncluded : options.ambientExcluded;
  if (names.empty()) return;
  ambient_.resize(scene.surfaces.size());
  for (const SurfaceId i : scene.surfaces.ids())
    ambient_[i] = (std::find(names.begin(), names.end(), scene.modifierName(scene.surfaces[i])) !=
                   names.end()) == including;
}

bool PreparedScene::glows(SurfaceList::Beginning surfaces) const {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    const Material* material = scene_.materialOf(surface);
    const auto* glow = material ? std::get_if<Glow>(material) : nullptr;
    return glow && !isBlack(glow->radiance);
  });
}

bool PreparedScene::isDark() const {
  return !scene_.importance && lights_.all().empty() && isBlack(options_.ambientValue) &&
         !glows(scene_.surfaces.first(scene_.surfaces.size()));
}

bool PreparedScene::lacksSources() const {
  return !scene_.importance && lights_.all().empty() &&
         !(options_.ambientBounces > 0 && glows(scene_.outermost()));
}

LightId PreparedScene::sourceNamed(std::string_view name) const {
  const auto& all = lights_.all();
  for (size_t i = all.size(); i-- > 0;) {
    std::string_view rest = name;
    const LightSource* light = &all[LightId(i)];
    for (; light->isVirtual(); light = &all[light->relayed]) {
      const size_t end = rest.find('>');
      if (end == rest.npos || rest.substr(0, end) != scene_.surfaceName(scene_.surfaces[light->surface]))
        break;
      rest.remove_prefix(end + 1);
    }
    if (!light->isVirtual() && rest == scene_.surfaceName(scene_.surfaces[light->surface])) return LightId(i);
  }
  return kNone;
}

void PreparedScene::findScatterers(const rad::Warn& warn) {
  for (const Modifier& m : scene_.modifiers) {
    const auto* material = std::get_if<Material>(&m.content);
    const auto* mist = material ? std::get_if<Mist>(material) : nullptr;
    if (!mist) continue;
    if (scatterersOf_.size() <= mist->number) scatterersOf_.resize(mist->number + 1);
    auto& own = scatterersOf_[mist->number];
    for (const std::string& name : mist->sources) {
      const LightId source = sourceNamed(name);
      if (source == kNone) {
        // In a scene with goals, light sources do not emit, so that the warning would be pointless.
        if (warn && !scene_.importance)
          warn(fmt::format("{}: unknown source \"{}\"", scene_.place(m.primitive), rad::printable(name)));
        continue;
      }
      auto found = std::find(scatterers_.begin(), scatterers_.end(), source);
      if (found == scatterers_.end()) found = scatterers_.insert(found, source);
      const auto position = static_cast<uint16_t>(found - scatterers_.begin());
      if (std::find(own.begin(), own.end(), position) == own.end()) own.push_back(position);
    }
    if (scatterers_.size() > UINT16_MAX)
      throw rad::Error(scene_.place(m.primitive) + ": mists name more than 65535 light sources");
  }
}

}  // namespace rsphere
