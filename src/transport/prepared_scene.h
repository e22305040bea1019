#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "light/source_choice.h"
#include "light/sources.h"
#include "scene/chosen_surfaces.h"
#include "scene/random.h"
#include "scene/scene.h"
#include "shade/surface_functions.h"
#include "trace/tracer.h"
#include "transport/presumed_shadows.h"
#include "transport/ray.h"
#include "transport/ray_options.h"

namespace rsphere {

// Seeds are combined with these bits, so that -Sr changes them. 0 for -Sr 0, where seeds depend only on
// places and rays.
inline uint64_t rotationBits(const RayOptions& options) {
  return options.rotation == 0 ? 0 : mixBits(options.rotation);
}

// The scene prepared for tracing: its tree, functions, light sources and options. Shared by all threads;
// constant once constructed. Keeps a reference to the scene.
class PreparedScene {
 public:
  // basicRadiance: refraction does not scale radiance by the square of the refractive index (-Sb). warn: gets
  // the warnings of SurfaceFunctions and LightSources.
  PreparedScene(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
                bool basicRadiance = false, const rad::Warn& warn = {});
  // The scene of another, with other options and without warnings. They share the tracer, which takes most of
  // the memory and time in a large scene. REQUIRES: -bv is the same.
  PreparedScene(const PreparedScene& other, const RayOptions& options);
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;

  const Scene& scene() const { return scene_; }
  const Tracer& tracer() const { return *tracer_; }
  const LightSources& lights() const { return lights_; }
  const PresumedShadows& presumedShadows() const { return presumedShadows_; }
  const SourceChoice& choice() const { return choice_; }
  const SurfaceFunctions& functions() const { return functions_; }
  const RayOptions& options() const { return options_; }
  IrradianceAt irradiance() const { return irradiance_; }
  bool basicRadiance() const { return basicRadiance_; }
  // A surface's own light, or kNone.
  LightId lightOf(SurfaceId surface) const {
    const auto number = luminous_.numberOf(surface);
    return number ? LightId(*number) : kNone;
  }
  // The radiance of a light source if it is the same from all points and directions;
  // null if it has to be computed for each ray.
  const Radiance* constantRadiance(LightId source) const {
    return constantRadiance_[source] ? &*constantRadiance_[source] : nullptr;
  }
  // Whether indirect light is computed on the surface (-ae, -ai).
  bool isAmbient(SurfaceId surface) const {
    return surface == kNone || ambient_.empty() || ambient_[surface];
  }
  // The medium of the space outside of mist and dielectrics (-me -ma -mg).
  Medium medium() const {
    return {options_.mediumExtinction, options_.mediumAlbedo, options_.mediumEccentricity};
  }
  // Light sources that any mist names; and those that one mist names, as
  // positions in scatterers().
  const std::vector<LightId>& scatterers() const { return scatterers_; }
  const std::vector<uint16_t>& scatterersOf(const Mist& mist) const { return scatterersOf_[mist.number]; }
  // Whether there is indirect light at all (-ab, -ad).
  bool hasIndirectLight() const { return options_.ambientBounces > 0 && options_.ambientDivisions > 0; }
  // Whether the scene has no light at all: no light sources, no glow, no ambient value, no goals.
  bool isDark() const;
  // Whether rtrace warns that there are no light sources: there is none, and either no surface glows or
  // there is no indirect light (-ab), which alone carries the light of glow without reach. The ambient value
  // makes no difference.
  bool lacksSources() const;
  // Surfaces of type source that emit light, in the order of the scene.
  const std::vector<SurfaceId>& distant() const { return distant_; }

 private:
  PreparedScene(const Scene& scene, std::shared_ptr<const Tracer> tracer, const RayOptions& options,
                IrradianceAt irradiance, bool basicRadiance, const rad::Warn& warn);
  bool glows(SurfaceList::Beginning surfaces) const;
  void findScatterers(const rad::Warn& warn);
  LightId sourceNamed(std::string_view name) const;

  const Scene& scene_;
  RayOptions options_;
  IrradianceAt irradiance_;
  bool basicRadiance_;
  std::shared_ptr<const Tracer> tracer_;
  SurfaceFunctions functions_;
  LightSources lights_;
  PresumedShadows presumedShadows_;
  SourceChoice choice_;
  ChosenSurfaces luminous_;  // those that are light sources: the first lights, in their order
  ById<LightId, std::optional<Radiance>> constantRadiance_;
  std::vector<SurfaceId> distant_;
  std::vector<LightId> scatterers_;
  std::vector<std::vector<uint16_t>> scatterersOf_;  // by Mist::number
  ById<SurfaceId, bool> ambient_;                    // empty: all of them
};

}  // namespace rsphere
