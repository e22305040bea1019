#pragma once
// Rays at the boundaries of volumes: mist, and antimatter, which cuts other surfaces away.
#include "shade/material_response.h"
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// The ray beyond a boundary of mist, which needs only to be passed on. If the ray began inside the mist that
// it leaves, that is added to the ray's space too. Throws rad::Error if the light of too many sources is
// scattered.
NextRay beyondMist(const PreparedScene& prepared, const CrossesMist& boundary, RayEnd& end);

// Sets what is cut away beyond a boundary of antimatter. Returns whether the ray hits the cut through a
// volume there: it has entered more of the volumes that are cut away than it has left.
bool entersCut(const Scene& scene, const CrossesAntimatter& boundary, RayEnd& end);

}  // namespace rsphere
