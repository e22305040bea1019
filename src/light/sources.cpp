#include "light/sources.h"

#include "light/relays.h"

namespace rsphere {

LightSources::LightSources(const Scene& scene) : scene_(scene) { findSources(); }

LightSources::LightSources(const Scene& scene, int relays, const SurfaceFunctions& functions,
                           const rad::Warn& warn)
    : scene_(scene) {
  findSources();
  addVirtualSources(scene, relays, functions, warn, sources_);
}

void LightSources::findSources() {
  // As in rtrace, luminous surfaces in octrees and meshes are visible but are not light sources.
  for (const SurfaceId i : scene_.outermostIds()) {
    const Surface& surface = scene_.surfaces[i];
    if (surface.material == kNone && !surface.finish.sensor) continue;
    if (scene_.importance) {
      if (surface.goal && canBeAimedAt(surface.shape, scene_)) sources_.push_back(lightSourceOf(scene_, i));
      continue;
    }
    const Material* material = scene_.materialOf(surface);
    if (!material || !isSampled(*material)) continue;
    const double reach = reachOf(*material);
    const bool distant = surface.shape.as<Distant>();
    if (distant ? reach != 0 : !isPlain(surface.shape)) continue;
    LightSource& source = sources_.emplace_back(lightSourceOf(scene_, i));
    source.reach = reach;
    if (const auto* spot = std::get_if<Spotlight>(material)) source.spot = *spot;
  }
}

}  // namespace rsphere
