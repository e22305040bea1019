#pragma once
// The light beyond portals (portals.h), as paths from the eye find it. Light paths receive it as a function,
// because PathTracer, which computes it, is itself built on them.
#include <vector>

#include "base/function_ref.h"
#include "base/radiometry.h"
#include "base/random.h"
#include "scene/shape.h"

namespace rsphere {

// The radiance (W/sr/m2) along an indirect ray. bounces: number of diffuse bounces that have led to the ray.
using OutdoorRadiance =
    FunctionRef<Radiance(const V3d& origin, const V3d& direction, int bounces, Random& random)>;

// The same, divided by the number of further diffuse bounces: element i of the result is the light after i of
// them.
using OutdoorParts = FunctionRef<void(const V3d& origin, const V3d& direction, int bounces, Random& random,
                                      std::vector<Radiance>& parts)>;

}  // namespace rsphere
