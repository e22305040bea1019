#pragma once
// Rays at the boundaries of volumes: mist, and antimatter, which cuts other surfaces away.
#include "shade/material_response.h"
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// The ray beyond a boundary of mist: a child of `ray` that needs only to be passed on. If the ray began
// inside the mist that it leaves, the mist is added to the ray too. Throws rad::Error if the light of too
// many sources is scattered.
Ray beyondMist(const PreparedScene& prepared, const CrossesMist& boundary, Ray& ray);

// Notes on the ray what is cut away beyond a boundary of antimatter. Returns whether the ray hits the cut
// through a volume there: it has entered more of the volumes that are cut away than it has left.
bool entersCut(const Scene& scene, const CrossesAntimatter& boundary, Ray& ray);

}  // namespace rsphere
