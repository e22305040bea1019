#pragma once
#include "scene/scene.h"

namespace rsphere {

// Throws rad::Error with an instance's place if an octree contains itself, or if octrees and meshes are
// nested more deeply than PlacementPath::kDeepest.
void checkNesting(const Scene& scene);

}  // namespace rsphere
