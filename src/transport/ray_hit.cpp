#include "transport/ray_hit.h"

#include <cmath>

#include "transport/ray_functions.h"

namespace rsphere {
namespace {

// Fused multiply-add rounds only once. On a plane at coordinate 0, the sign of the rounding error decides on
// which side of the plane a point lies, and function files that call floor() depend on it.
V3d along(const V3d& origin, double distance, const V3d& direction) {
  return V3d(std::fma(distance, direction.x, origin.x), std::fma(distance, direction.y, origin.y),
             std::fma(distance, direction.z, origin.z));
}

// Sets the distant source in the direction of a ray. The first one that is neither a glow nor an illum that
// transmits light hides the others; if there is none, it is the first glow.
void findDistant(const PreparedScene& prepared, Ray& ray) {
  const Scene& scene = prepared.scene();
  const auto sees = [&](SurfaceId surface) {
    return scene.surfaces[surface].shape.as<Distant>()->isSeenAlong(ray.direction);
  };
  if (ray.aimedAt != kNone) {
    const LightSource& light = prepared.lights().all()[ray.aimedAt];
    if (light.isDistant() && !light.isVirtual() && sees(light.surface)) ray.surface = light.surface;
    return;
  }
  SurfaceId glow;
  bool passedIllum = false;
  for (const SurfaceId s : prepared.distant()) {
    if (!sees(s)) continue;
    switch (coverOf(*scene.materialOf(scene.surfaces[s]))) {
      case Cover::yields:
        if (glow == kNone) glow = s;
        break;
      case Cover::passes:
        passedIllum = true;
        break;
      case Cover::hides:
        ray.surface = s;
        return;
    }
  }
  // The illum already includes the light behind it. An indirect ray through it would add that light twice.
  if (passedIllum && (ray.kinds & (kAmbient | kSpecular))) return;
  ray.surface = glow;
}

// Sets the hit of a shadow ray on the source that it is aimed at, and ignores all other surfaces.
void findTarget(const PreparedScene& prepared, Ray& ray) {
  const Scene& scene = prepared.scene();
  const LightSource& target = prepared.lights().all()[ray.aimedAt];
  ray.point = ray.origin;
  ray.normal = -ray.direction;
  ShapeHit hit;
  if (target.isDistant() && !target.isVirtual()) {
    findDistant(prepared, ray);
  } else if (intersect(scene.surfaces[target.surface].shape, scene.vertices, ray.origin, ray.direction,
                       kFarAway, hit)) {
    ray.surface = target.surface;
    ray.length = hit.distance;
    ray.point = along(ray.origin, hit.distance, ray.direction);
    ray.normal = hit.normal;
    ray.cosine = hit.cosine;
  }
}

}  // namespace

Hit findHit(const PreparedScene& prepared, Ray& ray) {
  if (ray.unobstructed) {
    findTarget(prepared, ray);
    return {};
  }
  const Hit hit = prepared.tracer().nearest(ray.origin, ray.direction,
                                            ray.farthest > kSamePlace ? ray.farthest : kFarAway,
                                            ray.parent ? ray.parent->surface : kNone);
  ray.surface = hit.surface;
  ray.point = ray.origin;
  ray.normal = -ray.direction;
  ray.cosine = 1;
  if (hit.surface != kNone) {
    ray.length = hit.distance;
    ray.point = along(ray.origin, hit.distance, ray.direction);
    ray.normal = hit.normal;
    ray.cosine = hit.cosine;
    ray.perturbation = hit.perturbation;
    ray.u = hit.u;
    ray.v = hit.v;
    ray.path = hit.path;
  } else if (ray.farthest > kSamePlace) {
    ray.point = along(ray.origin, ray.farthest, ray.direction);
  } else {
    findDistant(prepared, ray);
  }
  return hit;
}

}  // namespace rsphere
