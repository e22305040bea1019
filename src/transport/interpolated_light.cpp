#include "transport/interpolated_light.h"

#include <algorithm>
#include <cmath>

#include "transport/final_gather.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::Interpolation;

// Whether interpolated light is valid at the end of a ray. It was gathered in the whole scene, with nothing
// cut away by antimatter, and in the medium that fills the scene.
bool isOrdinary(const Ray& ray, const Medium& medium) {
  return !ray.mist && !ray.clips && !ray.clipsBeyond && !ray.scatterers.count &&
         ray.medium.extinction == medium.extinction;
}

SurfacePlace placeOf(const Ray& ray, const V3d& trueNormal) {
  return {ray.point, trueNormal, ray.surface, &ray.path, ray.length};
}

// The diffuse bounces that the limits allow beyond the end of a ray.
int bouncesLeft(const RayOptions& o, const Ray& ray) {
  int left = o.ambientBounces - ray.ambientLevel;
  if (o.reflectionLimit != 0) left = std::min(left, std::abs(o.reflectionLimit) - ray.level);
  if (o.reflectionLimit > 0)
    for (double weight = ray.weight / 2, n = 0; n < left; ++n, weight /= 2)
      if (weight < o.weightLimit) left = static_cast<int>(n);
  return std::max(left, 0);
}

}  // namespace

bool InterpolatedLight::add(Ray& ray, const V3d& normal, const V3d& trueNormal,
                            const Coefficient& coefficient) {
  // The light at an imagined point (-I) is not interpolated, because no other ray needs it.
  if (ray.surface == kNone) return false;
  if (!isOrdinary(ray, t_.medium()) || normal.dot(trueNormal) < Tuning::kLeastUpright) return false;
  TracedFieldRays rays(t_, follower_, ray.depth);
  GatheredLight light;
  if (!settings_.caches.field->find(placeOf(ray, trueNormal), reader_, rays, light)) return false;
  ray.value += coefficient * light.meanOfTilted(trueNormal, normal);
  return true;
}

bool InterpolatedLight::addFromPatch(Ray& ray, const V3d& normal, const V3d& trueNormal,
                                     const Coefficient& coefficient) {
  TracedFieldRays rays(t_, follower_, ray.depth);
  Patch* const patch = patchAt(ray, normal, trueNormal);
  if (!patch) return false;
  ray.value +=
      coefficient * Radiance(settings_.caches.coarse->light(*patch, bouncesLeft(t_.options(), ray), rays));
  return true;
}

Patch* InterpolatedLight::patchAt(const Ray& ray, const V3d& normal, const V3d& trueNormal) {
  const double u1 = state_.random.uniform(), u2 = state_.random.uniform();
  if (!isOrdinary(ray, t_.medium()) || normal.dot(trueNormal) < Tuning::kLeastUpright) return nullptr;
  TracedFieldRays rays(t_, follower_, ray.depth);
  return settings_.caches.coarse->find(placeOf(ray, trueNormal), u1, u2, rays);
}

void InterpolatedLight::endPath() {
  if (settings_.caches.field) settings_.caches.field->leave(reader_);
}

}  // namespace rsphere
