#pragma once
#include "scene/scene.h"

namespace rsphere {

// Throws rad::Error with the file and line of an instance if an octree contains itself, or if octrees and
// meshes are nested deeper than PlacementPath::kDeepest.
void checkNesting(const Scene& scene);

}  // namespace rsphere
