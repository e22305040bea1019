#pragma once

#include "scene/scene.h"

namespace rsphere {

// By surface: whether it may refract a ray that hits it, so that a shadow ray would not continue straight on.
// Such surfaces are those of dielectric and interface (also in a mixture, as the alternate of mirror or
// illum, or as the cut of antimatter), and instances and meshes that contain such surfaces. Shadow rays pass
// straight through all other materials, regardless of textures.
ById<SurfaceId, bool> refractingSurfaces(const Scene& scene);

}  // namespace rsphere
