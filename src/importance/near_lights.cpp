#include "importance/near_lights.h"

#include <algorithm>

namespace rsphere {
namespace {

double squaredDistance(const Box3d& box, const V3d& p) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double outside = std::max({box.min[i] - p[i], p[i] - box.max[i], 0.});
    sum += outside * outside;
  }
  return sum;
}

}  // namespace

std::vector<uint32_t> surfacesNearLights(const Scene& scene, const LightSources& lights) {
  std::vector<const LightSource*> near;
  std::vector<bool> shines(scene.surfaces.size(), false);
  for (const LightSource& light : lights.all()) {
    if (light.isVirtual()) continue;
    shines[light.surface] = true;
    if (!light.distant) near.push_back(&light);
  }
  std::vector<uint32_t> found;
  if (near.empty()) return found;
  const size_t most = std::max<size_t>(1, kMostNearPairs / scene.outermost().size());
  if (near.size() > most) {
    std::stable_sort(near.begin(), near.end(), [](auto* a, auto* b) { return a->radius > b->radius; });
    near.resize(most);
  }
  for (uint32_t i = 0; i < scene.outermost().size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (shines[i] || !isPlain(surface.shape)) continue;
    const Box3d box = bounds(surface.shape, scene.vertices);
    if (std::any_of(near.begin(), near.end(), [&](const LightSource* light) {
          const double reach = (1 + kNearLight) * light->radius;
          return squaredDistance(box, light->center) <= reach * reach;
        }))
      found.push_back(i);
  }
  return found;
}

}  // namespace rsphere
