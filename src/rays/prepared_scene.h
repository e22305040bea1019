#pragma once
#include <memory>

#include "base/random.h"
#include "rays/ray_options.h"
#include "rays/scene_lights.h"
#include "scene/scene.h"
#include "shade/surface_functions.h"
#include "trace/tracer.h"

namespace rsphere {

// Bits that are combined with seeds, so that -Sr changes all random numbers. They are 0 for -Sr 0, where
// seeds depend only on places and rays.
inline uint64_t rotationBits(const RayOptions& options) {
  return options.rotation == 0 ? 0 : mixBits(options.rotation);
}

// A scene prepared for tracing: tree, functions, light sources and options. Shared by all threads, and
// constant after construction. Keeps a reference to the scene.
class PreparedScene {
 public:
  // basicRadiance: refraction does not scale radiance by the square of the refractive index (-Sb). warn:
  // receives the warnings of SurfaceFunctions and LightSources, and of names of -ae and -ai that are the
  // modifier of no surface.
  PreparedScene(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
                bool basicRadiance = false, const rad::Warn& warn = {});
  // Prepares the scene of `other` for radiance, with other options, without warnings. They share the tracer,
  // which takes most of the memory and time in a large scene. REQUIRES that both have the same -bv.
  PreparedScene(const PreparedScene& other, const RayOptions& options);

  const Scene& scene() const { return scene_; }
  const Tracer& tracer() const { return *tracer_; }
  const SceneLights& lights() const { return lights_; }
  const SurfaceFunctions& functions() const { return functions_; }
  const RayOptions& options() const { return options_; }
  IrradianceAt irradiance() const { return irradiance_; }
  bool basicRadiance() const { return basicRadiance_; }
  // Whether indirect light is computed on the surface (-ae, -ai).
  bool isAmbient(SurfaceId surface) const {
    return surface == kNone || ambient_.empty() || ambient_[surface];
  }

 private:
  PreparedScene(const Scene& scene, std::shared_ptr<const Tracer> tracer, const RayOptions& options,
                IrradianceAt irradiance, bool basicRadiance, const rad::Warn& warn);

  const Scene& scene_;
  RayOptions options_;
  IrradianceAt irradiance_;
  bool basicRadiance_;
  std::shared_ptr<const Tracer> tracer_;
  SurfaceFunctions functions_;
  SceneLights lights_;
  ById<SurfaceId, bool> ambient_;  // empty: true for all surfaces
};

// Whether the scene has no light at all: no light sources, glow, ambient value or importance goals.
bool isDark(const PreparedScene& prepared);
// Whether rtrace warns that the scene has no light sources. This is so if there are no sources, and either no
// surface glows or there is no indirect light (-ab 0), which alone carries the light of glow without reach.
// The ambient value does not matter.
bool lacksSources(const PreparedScene& prepared);

// Whether shadow rays find all light. Daylight and glowing surfaces are found by indirect rays only.
bool isLitByLamps(const PreparedScene& prepared);

// Whether a participating medium (-me) or a volume of mist attenuates light. The parts of a ray's light
// cannot be separated there, because observers see them before they are attenuated.
bool hasMedia(const PreparedScene& prepared);

}  // namespace rsphere
