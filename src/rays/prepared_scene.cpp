#include "rays/prepared_scene.h"

#include <algorithm>
#include <utility>

#include "light/relays.h"
#include "scene/modifier_names.h"

namespace rsphere {
namespace {

bool glows(const Scene& scene, SurfaceList::Beginning surfaces) {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    const Material* material = scene.materialOf(surface);
    const auto* glow = material ? std::get_if<Glow>(material) : nullptr;
    return glow && !isBlack(glow->radiance);
  });
}

}  // namespace

static_assert(RayOptions::kAllBounces == kRelaysAsNeeded);
PreparedScene::PreparedScene(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
                             bool basicRadiance, const rad::Warn& warn)
    : PreparedScene(scene, std::make_shared<const Tracer>(scene, options.backFacesVisible), options,
                    irradiance, basicRadiance, warn) {}

PreparedScene::PreparedScene(const PreparedScene& other, const RayOptions& options)
    : PreparedScene(other.scene_, other.tracer_, options, IrradianceAt::none, other.basicRadiance_, {}) {}

PreparedScene::PreparedScene(const Scene& scene, std::shared_ptr<const Tracer> tracer,
                             const RayOptions& options, IrradianceAt irradiance, bool basicRadiance,
                             const rad::Warn& warn)
    : scene_(scene),
      options_(options),
      irradiance_(irradiance),
      basicRadiance_(basicRadiance),
      tracer_(std::move(tracer)),
      functions_(scene, options.sampling, warn, options.definitions, options.wavelengths),
      lights_(scene, *tracer_, functions_, options.directRelays, warn) {
  const bool including = !options.ambientIncluded.empty();
  const auto& names = including ? options.ambientIncluded : options.ambientExcluded;
  if (names.empty()) return;
  warnOfMissingModifiers(scene, names, including ? "-ai" : "-ae", warn);
  ambient_.resize(scene.surfaces.size());
  for (const SurfaceId i : scene.surfaces.ids())
    ambient_[i] =
        (std::ranges::find(names, scene.modifierName(scene.surfaces[i])) != names.end()) == including;
}

bool isDark(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene();
  return !scene.importance && prepared.lights().all().empty() && isBlack(prepared.options().ambientValue) &&
         !glows(scene, scene.surfaces.first(scene.surfaces.size()));
}

bool lacksSources(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene();
  return !scene.importance && prepared.lights().all().empty() &&
         !(prepared.options().ambientBounces > 0 && glows(scene, scene.outermost()));
}

bool hasMedia(const PreparedScene& prepared) {
  return !isBlack(prepared.options().medium().extinction) || !prepared.lights().ofMists().all().empty();
}

bool isLitByLamps(const PreparedScene& prepared) {
  for (const LightSource& light : prepared.lights().all())
    if (light.isDistant()) return false;
  const auto& modifiers = prepared.scene().modifiers;
  return std::ranges::none_of(modifiers, [](const Modifier& modifier) {
    const auto* material = std::get_if<Material>(&modifier.content);
    return material && std::holds_alternative<Glow>(*material);
  });
}

}  // namespace rsphere
