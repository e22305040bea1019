#pragma once
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// Whether each surface, by its index in Scene::surfaces, may refract a ray that meets it: shadow rays leave
// the straight line there. These are surfaces of dielectric and interface, also in a mixture, as the
// alternate of mirror or illum, or as the cut of antimatter; and instances and meshes that bring such
// surfaces in. Other materials let shadow rays pass straight, whatever textures they have.
std::vector<bool> refractingSurfaces(const Scene& scene);

}  // namespace rsphere
