#include "scene/nesting.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/overloaded.h"
#include "scene/arguments.h"

namespace rsphere {
namespace {

class Nesting {
 public:
  explicit Nesting(const Scene& scene) : scene_(scene), heights_(scene.groups.size(), kUnknown) {}

  // The number of levels of octrees and meshes below this group, which is at `depth`.
  int height(uint32_t group, int depth) {
    constexpr int kOpen = -1;
    int& known = heights_[group];
    if (known != kUnknown) return known;
    known = kOpen;
    int highest = 0;
    const SurfaceGroup& g = scene_.groups[group];
    for (const SurfaceId s : g.surfaces) {
      const Surface& surface = scene_.surfaces[s];
      const int under = match(
          surface.shape,
          [&](const Instance& instance) {
            if (heights_[instance.group] == kOpen) fail(surface, "an octree contains itself");
            return depth < kMostLevels ? 1 + height(instance.group, depth + 1) : kMostLevels + 1;
          },
          [](const MeshInstance&) { return 1; },
          [](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) { return 0; });
      if (depth + under > kMostLevels)
        fail(surface, fmt::format("octrees are nested more than {} deep", kMostLevels));
      highest = std::max(highest, under);
    }
    return heights_[group] = highest;
  }

 private:
  static constexpr int kUnknown = -2;
  static constexpr int kMostLevels = PlacementPath::kDeepest;

  [[noreturn]] void fail(const Surface& surface, std::string_view what) const {
    PrimitiveArguments(scene_.description, scene_.surfaces.primitiveOf(surface.id)).fail(what);
  }

  const Scene& scene_;
  std::vector<int> heights_;  // by group
};

}  // namespace

void checkNesting(const Scene& scene) {
  if (scene.groups.size() > 1) Nesting(scene).height(0, 0);
}

}  // namespace rsphere
