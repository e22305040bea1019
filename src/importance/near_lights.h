#pragma once
#include <cstdint>
#include <vector>

#include "light/sources.h"
#include "scene/scene.h"

namespace rsphere {

// Surfaces that are as near to a light source as it is large, whatever their material: their light may vary
// more than that of all others, from the rim of a luminaire to the partition beside a desk that is a goal.
// The paper names them as future work. Indices in Scene::surfaces, in their order; light sources are none.
// Where surfaces times sources are more than kMostNearPairs only the sources that are largest are asked.
std::vector<uint32_t> surfacesNearLights(const Scene& scene, const LightSources& lights);

// Between a surface's box and the sphere around a source, in radii of it, at most.
inline constexpr double kNearLight = .5;
inline constexpr size_t kMostNearPairs = 4'000'000;

}  // namespace rsphere
