#pragma once
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// What the tracer finds along a ray (Tracer::nearest); nothing for an unobstructed shadow ray.
Hit nearestHit(const PreparedScene& prepared, const RayQuery& ray);

// Sets the hit of a ray, which has none yet: the tracer's, otherwise the distant source in its direction. An
// unobstructed shadow ray always hits the source that it is aimed at.
void setHit(const PreparedScene& prepared, const Hit& nearest, RayEnd& end);

}  // namespace rsphere
