#include "transport/interpolated_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "transport/ray_functions.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::Interpolation;

// By a few rays.
Surroundings surroundingsOf(const Tracer& tracer, const GatherSite& site) {
  // By projected solid angle, in the frame of the site.
  static const auto directions = [] {
    const HemisphereCells cells(Tuning::kReachRays);
    std::vector<V3d> of(cells.count());
    for (int i = 0; i < cells.count(); ++i)
      of[i] = cells.direction(i, .5, .5, V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1));
    return of;
  }();
  V3d x, y;
  frame(site.normal, x, y);
  double inverse = 0, squares = 0, hits = 0;
  for (const V3d& d : directions) {
    const Hit hit = tracer.nearest(site.point, d.x * x + d.y * y + d.z * site.normal);
    if (hit.surface == kNone) continue;
    ++hits;
    inverse += 1 / hit.distance;
    squares += hit.distance * hit.distance;
  }
  if (hits == 0) return {kFarAway, kFarAway, 0};
  const auto count = static_cast<double>(directions.size());
  return {count / inverse, std::sqrt(squares / hits), hits / count};
}

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

// The rays that the fields ask for, on behalf of a path of this depth.
class Looker final : public SiteLooker, public CoarseSolution::Looker {
 public:
  Looker(const Tracer& tracer, SiteGatherer& gatherer, int depth)
      : tracer_(tracer), gatherer_(gatherer), depth_(depth) {}
  GatheredLight gather(const GatherSite& site, double nearest, uint64_t seed) override {
    return gatherer_.gather(site, nearest, seed, depth_);
  }
  double clearance(const GatherSite& site, double farthest) override {
    const Hit hit = tracer_.nearest(site.point, site.normal, farthest);
    return hit.surface == kNone ? farthest : hit.distance;
  }
  void link(const GatherSite& site, int rays, uint64_t seed, CoarseSolution::Links& links) override {
    gatherer_.link(site, rays, seed, depth_, links);
  }
  bool sees(const V3d& from, const V3d& to) override {
    const V3d way = to - from;
    const double length = way.length();
    return !(length > kSamePlace) || tracer_.isClear(from, way / length, length);
  }
  Surroundings surroundings(const GatherSite& site) override { return surroundingsOf(tracer_, site); }
  bool smallObjectNear(const GatherSite& site, double side, double lift) override {
    // Rounding must not make an object that is as wide as the cell seem smaller.
    constexpr double kRounding = 1e-6;
    return tracer_.anySmallNear({site.point, site.normal, side, side * (1 - kRounding), 3 * lift});
  }

 private:
  const Tracer& tracer_;
  SiteGatherer& gatherer_;
  int depth_;
};

}  // namespace

bool InterpolatedLight::add(Ray& ray, const V3d& normal, const V3d& trueNormal,
                            const Coefficient& coefficient) {
  // The light at an imagined point (-I) is not interpolated, because no other ray needs it.
  if (ray.surface == kNone) return false;
  if (!isOrdinary(ray, t_.medium()) || normal.dot(trueNormal) < Tuning::kLeastUpright) return false;
  Looker looker(t_.tracer(), gatherer_, ray.depth);
  GatheredLight light;
  if (!settings_.caches.field->find(placeOf(ray, trueNormal), reader_, looker, light)) return false;
  ray.value += coefficient * light.meanOfTilted(trueNormal, normal);
  return true;
}

bool InterpolatedLight::addFromPatch(Ray& ray, const V3d& normal, const V3d& trueNormal,
                                     const Coefficient& coefficient) {
  Looker looker(t_.tracer(), gatherer_, ray.depth);
  const int beyond = ray.ambientLevel - 1;
  const bool isLast = state_.links && ray.ambientLevel >= bouncesBeyondPatches(t_.options());
  CoarseSolution::Patch* patch = nullptr;
  if (!isLast) {
    const double u1 = state_.random.uniform(), u2 = state_.random.uniform();
    if (isOrdinary(ray, t_.medium()) && normal.dot(trueNormal) >= Tuning::kLeastUpright)
      patch = settings_.caches.coarse->find(placeOf(ray, trueNormal), u1, u2, looker);
  }
  if (state_.links) {
    const Coefficient whole = coefficient * ray.contribution * passedBy(ray);
    if (patch)
      state_.links->add(patch, whole, beyond);
    else
      state_.links->addEnd(beyond, whole);
    if (isLast) return true;
  } else if (patch) {
    ray.value += coefficient *
                 Radiance(settings_.caches.coarse->light(*patch, bouncesLeft(t_.options(), ray), looker));
  }
  return patch;
}

void InterpolatedLight::endPath() {
  if (settings_.caches.field) settings_.caches.field->leave(reader_);
}

}  // namespace rsphere
