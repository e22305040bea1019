#pragma once
// Rays at the boundaries of volumes: mist, and antimatter, which cuts other surfaces away.
#include "shade/material_response.h"
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// The continuation of a ray beyond a boundary of mist, ready to be followed. If the ray leaves a mist in
// which it began, that mist is added to the ray's own space too. Throws rad::Error if the light of too many
// sources is scattered.
NextRay beyondMist(const PreparedScene& prepared, const CrossesMist& boundary, RayEnd& end);

// Sets which surfaces are cut away beyond a boundary of antimatter. Returns whether the ray hits the cut face
// of a volume there: it does if it has entered more of the volumes that are cut away than it has left.
bool entersCut(const Scene& scene, const CrossesAntimatter& boundary, RayEnd& end);

}  // namespace rsphere
