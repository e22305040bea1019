#pragma once
// Handles rays at boundaries of volumes: mist, and antimatter, which cuts away other surfaces.
#include "rays/prepared_scene.h"
#include "rays/ray.h"
#include "shade/material_response.h"

namespace rsphere {

// The continuation of a ray beyond a boundary of mist. If the ray leaves a mist that it has not entered, it
// started inside, and its own space gets that mist, too. Throws rad::Error if too many sources are scattered.
NextRay beyondMist(const PreparedScene& prepared, const CrossesMist& boundary, RayEnd& end);

// Determines which surfaces are cut away beyond a boundary of antimatter. Returns whether the ray hits the
// cut face of a volume there. This is so if the ray has entered more of the cut volumes than it has left.
bool entersCut(const Scene& scene, const CrossesAntimatter& boundary, RayEnd& end);

}  // namespace rsphere
