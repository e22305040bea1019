#pragma once
#include "rays/prepared_scene.h"
#include "rays/ray.h"

namespace rsphere {

// Determines the hit of a ray: the surface that the tracer finds (Tracer::nearest), otherwise the distant
// source in its direction. An unobstructed shadow ray always hits the source at which it is aimed. Returns
// the tracer's hit. REQUIRES that the ray has no hit yet.
Hit findHit(const PreparedScene& prepared, RayEnd& end);

// Lets a ray hit the sample of a source at which it is aimed.
void putAtSource(RayEnd& end, const LightSource& source, const SourceSample& sample);

}  // namespace rsphere
