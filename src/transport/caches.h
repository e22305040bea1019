#pragma once
// The caches of interpolated light (-aa above 0). All threads share them, and tracing adds to them.
#include <memory>

#include "field/coarse_solution.h"
#include "field/field_options.h"
#include "field/irradiance_field.h"
#include "transport/aims.h"
#include "transport/prepared_scene.h"

namespace rsphere {

// The options of the fields of interpolated light.
FieldOptions fieldOptions(const RayOptions& options);

struct Caches {
  // Light at the first diffuse surfaces; null without interpolation (-aa 0).
  std::unique_ptr<IrradianceField> field;
  // Light at second and later diffuse surfaces; null where paths are followed instead (-aa 0, -ab 1).
  std::unique_ptr<CoarseSolution> coarse;
  // The aims of gathers for the caches. They do not depend on the tracer that needs the light.
  Aims aims;
};

// The caches that the options ask for, with the light of the ambient file in them (-af). Keeps references to
// the scene and to what the aims refer to. warn: gets the warnings of the ambient file.
Caches makeCaches(const PreparedScene& prepared, const Aims& aims, const rad::Warn& warn);

// The number of diffuse bounces beyond a patch of the coarse solution: one less where patches never serve the
// first surface.
inline int bouncesBeyondPatches(const RayOptions& options) {
  return options.ambientBounces - (options.leastForPatches > 0 ? 0 : 1);
}

}  // namespace rsphere
