#pragma once
// The caches of interpolated light (-aa above 0). All threads share them, and tracing adds to them.
#include <cstdint>
#include <memory>

#include "field/coarse_solution.h"
#include "field/field_options.h"
#include "field/irradiance_field.h"
#include "rays/prepared_scene.h"
#include "transport/aims.h"

namespace rsphere {

// The options of the irradiance cache and the coarse solution.
FieldOptions fieldOptions(const RayOptions& options);

// What lights a place: lamps alone (isLitByLamps()), daylight through openings at which rays are aimed, such
// daylight with patches of sun, or anything else.
enum class LitBy : uint8_t { lamps, openings, sun, other };
// byLamps: isLitByLamps().
LitBy litBy(const Aims& aims, bool byLamps);
// The number of rays of a record of the irradiance cache.
int raysOfRecord(const RayOptions& options, LitBy by);

struct Caches {
  // Light at the first diffuse surfaces; null without interpolation (-aa 0).
  std::unique_ptr<IrradianceField> field;
  // Light at the second and later diffuse surfaces; null if paths are followed instead (-aa 0, -ab 1).
  std::unique_ptr<CoarseSolution> coarse;
  // Final gathers that fill the caches aim some of their rays at these places. All tracers that use the
  // caches share them.
  Aims aims;
  // isLitByLamps()
  bool byLamps = false;
};

// Makes the caches that the options require, and loads the light of the ambient file (-af). Keeps references
// to the scene and to the places of `aims`. warn: receives warnings about the ambient file.
Caches makeCaches(const PreparedScene& prepared, const Aims& aims, const rad::Warn& warn);

// The number of diffuse bounces beyond a patch of the coarse solution. It is one less if patches are never
// used at the first surface.
inline int bouncesBeyondPatches(const RayOptions& options) {
  return options.ambientBounces - (options.leastForPatches > 0 ? 0 : 1);
}

}  // namespace rsphere
