#pragma once
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// Finds the surface that a ray hits (Tracer::nearest), otherwise the distant source in its direction, and
// sets the ray's surface, length, point, normal and cosine. An unobstructed shadow ray always hits the source
// that it is aimed at. Returns the tracer's hit.
Hit findHit(const PreparedScene& prepared, Ray& ray);

}  // namespace rsphere
