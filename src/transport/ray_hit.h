#pragma once
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// Sets the hit of a ray, which has none yet: the surface that the tracer finds (Tracer::nearest), otherwise
// the distant source in its direction. An unobstructed shadow ray always hits the source that it is aimed at.
// Returns the tracer's hit.
Hit findHit(const PreparedScene& prepared, RayEnd& end);

}  // namespace rsphere
