#include "rays/scene_lights.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/constants.h"
#include "rad_parser/printable.h"
#include "rays/tuning.h"

namespace rsphere {
namespace {

LightId sourceNamed(const Scene& scene, const LightSources& lights, std::string_view name) {
  const auto& all = lights.all();
  for (size_t i = all.size(); i-- > 0;) {
    std::string_view rest = name;
    const LightSource* light = &all[LightId(i)];
    for (; light->isVirtual(); light = &all[light->relayed]) {
      const size_t end = rest.find('>');
      if (end == rest.npos || rest.substr(0, end) != scene.surfaceName(scene.surfaces[light->surface])) break;
      rest.remove_prefix(end + 1);
    }
    if (!light->isVirtual() && rest == scene.surfaceName(scene.surfaces[light->surface])) return LightId(i);
  }
  return kNone;
}

static_assert(kLightForms == 8, "May samples lie outside the surface?");
// A box that contains all samples of a source. For a virtual source it contains the relay, which rays to the
// source hit first. Empty for distant sources.
Box3d boxOf(const Scene& scene, const LightSource& light) {
  if (light.isDistant() && !light.isVirtual()) return {};
  Box3d box = bounds(scene.surfaces[light.surface].shape, scene.vertices);
  if (light.isVirtual()) return box;
  V3d reach(light.radius);
  if (const auto* plane = light.as<PlaneLight>())
    for (int i = 0; i < 3; ++i) reach[i] = std::abs(plane->u[i]) + std::abs(plane->v[i]);
  box.extendBy(light.center - reach);
  box.extendBy(light.center + reach);
  return box;
}

std::vector<Box3d> boxesOf(const Scene& scene, const LightSources& lights) {
  std::vector<Box3d> boxes;
  for (const LightSource& light : lights.all()) boxes.push_back(boxOf(scene, light));
  return boxes;
}

}  // namespace

MistSources::MistSources(const Scene& scene, const LightSources& lights, const rad::Warn& warn) {
  for (const Modifier& m : scene.modifiers) {
    const auto* material = std::get_if<Material>(&m.content);
    const auto* mist = material ? std::get_if<Mist>(material) : nullptr;
    if (!mist) continue;
    if (ofMist_.size() <= mist->number) ofMist_.resize(mist->number + 1);
    auto& own = ofMist_[mist->number];
    for (const std::string& name : mist->sources) {
      const LightId source = sourceNamed(scene, lights, name);
      if (source == kNone) {
        // No warning in a scene with importance goals, where light sources do not emit.
        if (warn && !scene.importance)
          warn(fmt::format("{}: unknown source \"{}\"", scene.place(m.primitive), rad::printable(name)));
        continue;
      }
      auto found = std::ranges::find(all_, source);
      if (found == all_.end()) found = all_.insert(found, source);
      const auto position = static_cast<uint16_t>(found - all_.begin());
      if (std::ranges::find(own, position) == own.end()) own.push_back(position);
    }
    if (all_.size() > UINT16_MAX)
      throw rad::Error(scene.place(m.primitive) + ": mists name more than 65535 light sources");
  }
}

SceneLights::SceneLights(const Scene& scene, const Tracer& tracer, const SurfaceFunctions& functions,
                         int relays, const rad::Warn& warn)
    : LightSources(scene, relays, functions, warn),
      presumedShadows_(scene, tracer, *this),
      choice_(scene, *this),
      hidden_(std::make_shared<const Blockers>(scene, tracer), boxesOf(scene, *this),
              tuning::SceneLights::kFewSources),
      ofMists_(scene, *this, warn),
      luminous_(scene.surfaces.size()) {
  constantRadiance_.resize(all().size());
  for (const LightId i : all().ids()) {
    if (all()[i].isVirtual()) continue;
    luminous_.add(all()[i].surface);
    const Surface& surface = scene.surfaces[all()[i].surface];
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
}

}  // namespace rsphere
