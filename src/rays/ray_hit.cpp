#include "rays/ray_hit.h"

#include <cmath>

namespace rsphere {
namespace {

// Fused multiply-add rounds only once. On a plane at coordinate 0, the sign of the rounding error determines
// on which side of the plane a point lies, which matters to function files that call floor().
V3d along(const V3d& origin, double distance, const V3d& direction) {
  return V3d(std::fma(distance, direction.x, origin.x), std::fma(distance, direction.y, origin.y),
             std::fma(distance, direction.z, origin.z));
}

// The distant source in the direction of a ray, or kNone. The result is the first source that is neither a
// glow nor an illum that transmits light, because it hides all others; if there is none, the first glow.
SurfaceId distantSource(const PreparedScene& prepared, const RayQuery& ray, unsigned kinds) {
  const Scene& scene = prepared.scene();
  const auto sees = [&](SurfaceId surface) {
    return scene.surfaces[surface].shape.as<Distant>()->isSeenAlong(ray.direction);
  };
  if (ray.aimedAt != kNone) {
    const LightSource& light = prepared.lights().all()[ray.aimedAt];
    return light.isDistant() && !light.isVirtual() && sees(light.surface) ? light.surface : kNone;
  }
  SurfaceId glow;
  bool passedIllum = false;
  for (const SurfaceId s : prepared.lights().distant()) {
    if (!sees(s)) continue;
    switch (coverOf(*scene.materialOf(scene.surfaces[s]))) {
      case Cover::yields:
        if (glow == kNone) glow = s;
        break;
      case Cover::passes: passedIllum = true; break;
      case Cover::hides: return s;
    }
  }
  // The illum includes the light from behind it. An indirect ray through it would count that light twice.
  return passedIllum && (kinds & (kAmbient | kSpecular)) ? SurfaceId() : glow;
}

// Sets the hit of a shadow ray on the source at which it is aimed, ignoring all other surfaces.
void setTarget(const PreparedScene& prepared, RayEnd& end) {
  const RayQuery& ray = end.ray;
  SurfaceHit& hit = end.hit;
  const Scene& scene = prepared.scene();
  const LightSource& target = prepared.lights().all()[ray.aimedAt];
  ShapeHit found;
  if (target.isDistant() && !target.isVirtual()) {
    hit.surface = distantSource(prepared, ray, end.context.kinds);
  } else if (intersect(scene.surfaces[target.surface].shape, scene.vertices, ray.origin, ray.direction,
                       kFarAway, found, scene.samePlace)) {
    hit.surface = target.surface;
    hit.length = found.distance;
    hit.point = along(ray.origin, found.distance, ray.direction);
    hit.normal = found.normal;
    hit.cosine = found.cosine;
  }
}

}  // namespace

Hit findHit(const PreparedScene& prepared, RayEnd& end) {
  const RayQuery& ray = end.ray;
  SurfaceHit& hit = end.hit;
  const bool hasEnd = ray.farthest > 0 && ray.farthest > prepared.scene().samePlace;
  hit.point = ray.origin;
  hit.normal = -ray.direction;
  Hit nearest = ray.unobstructed ? Hit()
                                 : prepared.tracer().nearest(ray.origin, ray.direction,
                                                             hasEnd ? ray.farthest : kFarAway, ray.from);
  if (ray.unobstructed) {
    setTarget(prepared, end);
  } else if (nearest.surface != kNone) {
    hit.surface = nearest.surface;
    hit.length = nearest.distance;
    hit.point = along(ray.origin, nearest.distance, ray.direction);
    hit.normal = nearest.normal;
    hit.cosine = nearest.cosine;
    hit.perturbation = nearest.perturbation;
    hit.u = nearest.u;
    hit.v = nearest.v;
    hit.path = nearest.path;
  } else if (hasEnd) {
    hit.point = along(ray.origin, ray.farthest, ray.direction);
  } else {
    hit.surface = distantSource(prepared, ray, end.context.kinds);
  }
  return nearest;
}

void putAtSource(RayEnd& end, const LightSource& source, const SourceSample& sample) {
  end.hit.surface = source.surface;
  end.hit.length = sample.distance;
  end.hit.point =
      sample.distance < kFarAway ? end.ray.origin + sample.distance * end.ray.direction : end.ray.origin;
  end.hit.normal = sample.normal;
  end.hit.cosine = sample.cosine;
}

}  // namespace rsphere
