#include "transport/light_patches.h"

#include <algorithm>

#include "transport/light_particles.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::LightPatches;

// Surfaces without a diffuse reflection that a particle meets in succession.
constexpr int kMostSharp = 16;

}  // namespace

LightPatches::LightPatches(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene();
  const Tracer& tracer = prepared.tracer();
  const int bounces = prepared.options().ambientBounces;
  const auto follow = [&](V3d origin, V3d direction, double power, Random& random) {
    int scattered = 0;
    for (int sharp = 0; scattered <= bounces && sharp < kMostSharp;) {
      const Hit hit = tracer.nearest(origin, direction);
      if (hit.surface == kNone) return;
      const V3d point = origin + hit.distance * direction, front = hit.cosine < 0 ? -hit.normal : hit.normal;
      const Material* material = scene.materialOf(scene.surfaces[hit.surface]);
      if (!material || isTransparent(*material)) {
        // Panes take little of it. What is refracted is left out.
        if (material && isBoundary(*material)) return;
        ++sharp;
        origin = point + 2 * kSamePlace * direction;
        continue;
      }
      const auto diffuse = diffuseReflection(*material);
      const auto mirrored = mirrorReflection(*material);
      const bool rough = mirrored && mirrored->roughness > Tuning::kSmooth;
      // A rough highlight sends its light into fewer directions, from which it is brighter.
      const double scatters = (diffuse ? brightness(diffuse->color) * diffuse->share : 0) +
                              (rough ? mirrored->brightness : 0),
                   mirrors = mirrored && !rough ? mirrored->brightness : 0;
      if (scatters > 0) patches_.push_back({point, front, power * scatters});
      const double u = random.uniform() * std::max(1., mirrors + scatters);
      if (u < mirrors) {
        ++sharp;
        direction -= 2 * direction.dot(front) * front;
      } else if (u < mirrors + scatters) {
        ++scattered;
        direction = sentFrom(front, random);
      } else {
        return;
      }
      origin = point + 2 * kSamePlace * front;
    }
  };
  sendParticles(scene, tracer, prepared.lights(), Tuning::kParticles,
                [&](const V3d& origin, const V3d& direction, double power, const Surface&, Random& random) {
                  follow(origin, direction, power, random);
                });
  if (!patches_.empty()) area_ = scene.area() / static_cast<double>(patches_.size());
}

}  // namespace rsphere
