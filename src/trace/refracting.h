#pragma once
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// For each surface, by its index in Scene::surfaces: whether it may refract a ray that hits it, so
// that a shadow ray would leave the straight line there. Such surfaces are those of dielectric and
// interface (also in a mixture, as the alternate of mirror or illum, or as the cut of antimatter), and
// instances and meshes that contain such surfaces. All other materials let shadow rays pass straight
// through, whatever textures they have.
ById<SurfaceId, bool> refractingSurfaces(const Scene& scene);

}  // namespace rsphere
