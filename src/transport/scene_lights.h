#pragma once
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "light/source_choice.h"
#include "light/sources.h"
#include "scene/chosen_surfaces.h"
#include "shade/surface_functions.h"
#include "transport/hidden_boxes.h"
#include "transport/presumed_shadows.h"

namespace rsphere {

// The light sources that mists name (the materials of type mist that list sources).
class MistSources {
 public:
  // warn: called with names that no light source has. Throws rad::Error if mists name more than 65535
  // sources.
  MistSources(const Scene& scene, const LightSources& lights, const rad::Warn& warn);

  // Those that any mist names.
  const std::vector<LightId>& all() const { return all_; }
  // Those that one mist names, as positions in all().
  const std::vector<uint16_t>& of(const Mist& mist) const { return ofMist_[mist.number]; }

 private:
  std::vector<LightId> all_;
  std::vector<std::vector<uint16_t>> ofMist_;  // by Mist::number
};

// The light sources of a scene, and the facts about them that tracing needs. Shared by all threads.
class SceneLights : public LightSources {
 public:
  // relays: -dr. warn: gets the warnings of LightSources and MistSources. Keeps references to the scene and
  // the tracer.
  SceneLights(const Scene& scene, const Tracer& tracer, const SurfaceFunctions& functions, int relays,
              const rad::Warn& warn);
  SceneLights(const SceneLights&) = delete;
  SceneLights& operator=(const SceneLights&) = delete;

  // A surface's own light, or kNone.
  LightId of(SurfaceId surface) const {
    const auto number = luminous_.numberOf(surface);
    return number ? LightId(*number) : kNone;
  }
  // The radiance of a light source if it is the same from all points and directions; null if it has to be
  // computed for each ray.
  const Radiance* constantRadiance(LightId source) const {
    return constantRadiance_[source] ? &*constantRadiance_[source] : nullptr;
  }
  // Surfaces of type source that emit light, in the order of the scene.
  const std::vector<SurfaceId>& distant() const { return distant_; }
  const PresumedShadows& presumedShadows() const { return presumedShadows_; }
  const SourceChoice& choice() const { return choice_; }
  // Finds light sources that are hidden from a point, by their numbers. An image of a source is hidden if the
  // relay that shows it is.
  const HiddenBoxes& hidden() const { return hidden_; }
  const MistSources& ofMists() const { return ofMists_; }

 private:
  PresumedShadows presumedShadows_;
  SourceChoice choice_;
  HiddenBoxes hidden_;
  MistSources ofMists_;
  ChosenSurfaces luminous_;  // surfaces that are light sources, which are the first lights, in the same order
  ById<LightId, std::optional<Radiance>> constantRadiance_;
  std::vector<SurfaceId> distant_;
};

}  // namespace rsphere
