#pragma once
// The light beyond portals (portals.h), found by paths from the eye. Light paths receive it as a function,
// because PathTracer, which computes it, depends on light paths.
#include <vector>

#include "base/function_ref.h"
#include "base/radiometry.h"
#include "base/random.h"
#include "scene/shape.h"

namespace rsphere {

// The radiance (W/sr/m2) along an indirect ray. bounces: number of diffuse bounces that have led to the ray.
using OutdoorRadiance =
    FunctionRef<Radiance(const V3d& origin, const V3d& direction, int bounces, Random& random)>;

// OutdoorRadiance, separated by the number of further diffuse bounces: element i of the result is the light
// after i bounces.
using OutdoorParts = FunctionRef<void(const V3d& origin, const V3d& direction, int bounces, Random& random,
                                      std::vector<Radiance>& parts)>;

}  // namespace rsphere
