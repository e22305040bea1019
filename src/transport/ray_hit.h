#pragma once
#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

// Finds the surface that a ray hits (Tracer::nearest), or else the distant source that it sees, and sets the
// ray's surface, length, point, normal and cosine. A shadow ray that is unobstructed hits the source that it
// is aimed at. Returns the tracer's hit.
Hit findHit(const Transport& transport, Ray& ray);

}  // namespace rsphere
