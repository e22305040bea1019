#pragma once
#include <optional>
#include <vector>

#include "light/source_choice.h"
#include "light/sources.h"
#include "occluders/hidden_boxes.h"
#include "rays/chosen_surfaces.h"
#include "rays/presumed_shadows.h"
#include "shade/surface_functions.h"

namespace rsphere {

// The light sources that materials of type mist name.
class MistSources {
 public:
  // warn: called for names that no light source has. Throws rad::Error if mists name more than 65535 sources.
  MistSources(const Scene& scene, const LightSources& lights, const rad::Warn& warn);

  // All light sources that are named by any mist.
  const std::vector<LightId>& all() const { return all_; }
  // The light sources that one mist names, as indices in all().
  const std::vector<uint16_t>& of(const Mist& mist) const { return ofMist_[mist.number]; }

 private:
  std::vector<LightId> all_;
  std::vector<std::vector<uint16_t>> ofMist_;  // index: Mist::number
};

// The light sources of a scene, with data about them that tracing needs. Shared by all threads.
class SceneLights : public LightSources {
 public:
  // relays: -dr. warn: receives the warnings of LightSources and MistSources. Keeps references to the scene
  // and the tracer.
  SceneLights(const Scene& scene, const Tracer& tracer, const SurfaceFunctions& functions, int relays,
              const rad::Warn& warn);
  SceneLights(const SceneLights&) = delete;
  SceneLights& operator=(const SceneLights&) = delete;

  // The light source that a surface is, or kNone.
  LightId of(SurfaceId surface) const {
    const auto number = luminous_.numberOf(surface);
    return number ? LightId(*number) : kNone;
  }
  // The radiance of a light source if it does not depend on point and direction; null if it must be computed
  // for each ray.
  const Radiance* constantRadiance(LightId source) const {
    return constantRadiance_[source] ? &*constantRadiance_[source] : nullptr;
  }
  // Surfaces of type source that emit light, in the order of the scene.
  const std::vector<SurfaceId>& distant() const { return distant_; }
  const PresumedShadows& presumedShadows() const { return presumedShadows_; }
  const SourceChoice& choice() const { return choice_; }
  // Finds light sources that are hidden from a point, by their numbers. A virtual source is hidden if its
  // relay is hidden.
  const HiddenBoxes& hidden() const { return hidden_; }
  const MistSources& ofMists() const { return ofMists_; }

 private:
  PresumedShadows presumedShadows_;
  SourceChoice choice_;
  HiddenBoxes hidden_;
  MistSources ofMists_;
  ChosenSurfaces luminous_;  // surfaces that are light sources; they are the first lights, in this order
  ById<LightId, std::optional<Radiance>> constantRadiance_;
  std::vector<SurfaceId> distant_;
};

}  // namespace rsphere
