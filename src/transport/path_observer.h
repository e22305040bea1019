#pragma once
// Results of a path besides its radiance.
#include <functional>

#include "transport/ray.h"

namespace rsphere {

// The light source that a primary ray showed, and the surface that mirrored it;
// kNone if there is none.
struct ShownSource {
  SurfaceId source;
  SurfaceId mirror;
  bool operator==(const ShownSource&) const = default;
};

// Gets every finished ray of a path (rtrace's -ot, -oT). The attenuation by the medium in front of its hit is
// not yet in its value.
using RayObserver = std::function<void(const Ray& ray)>;

}  // namespace rsphere
