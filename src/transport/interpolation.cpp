// Indirect light from the field of interpolation (-aa).
#include <algorithm>
#include <cmath>
#include <utility>

#include "transport/irradiance_field.h"
#include "transport/path_tracer.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

// The cosine of the greatest tilt of the normal that light is interpolated for.
constexpr double kLeastUpright = .7;

// The height over the plane of the rays that look for what stands around a site, as the tangent.
constexpr double kSurveyHeights[] = {.09, .36};

// Two rings of four.
constexpr int kReachRays = 8;

// A site has as many divisions at least, or else what -ad asks for; and at most this many times -ad of
// super-samples: -as has a default that is meant for more.
constexpr int kLeastRays = 48, kMoreRays = 4;
constexpr double kLeastOfSecond = 64;  // their chance is what all sites around have in common

}  // namespace

// Whether the field has what addIndirect() asks for, and added it.
bool PathTracer::addInterpolated(Ray& ray, const V3d& normal, const V3d& trueNormal, const Rgb& coefficient) {
  IrradianceField& field = *t_.field();
  // Sites see what the world sees: nothing cut away, and no medium of its own around them.
  if (ray.mist || ray.clips || ray.clipsBeyond || ray.scatterers.count ||
      ray.medium.extinction != t_.medium().extinction)
    return false;
  // Beyond the second diffuse surface one path tells.
  if (ray.ambientLevel > 1) return false;
  if (normal.dot(trueNormal) < kLeastUpright) return false;
  FieldPlace place;
  place.point = ray.point;
  place.normal = trueNormal;
  place.surface = ray.surface;
  if (ray.path.count > 0) place.scale = t_.scene().placementOf(ray.path).toOuter.scale;
  struct Looker final : SiteLooker {
    PathTracer& tracer;
    int depth;
    Looker(PathTracer& t, int d) : tracer(t), depth(d) {}
    GatheredLight gather(const GatherSite& site, LightOf of, double share, uint64_t seed) override {
      return tracer.gather(site, of, share, seed, depth);
    }
    double reach(const GatherSite& site, double nearest) override { return tracer.reach(site, nearest); }
    Surroundings survey(const GatherSite& site, double farthest) override {
      return tracer.survey(site, farthest);
    }
    bool sees(const V3d& from, const V3d& to) override {
      const V3d way = to - from;
      const double length = way.length();
      return !(length > kSamePlace) ||
             tracer.t_.tracer().nearest(from, way / length, length).surface == kNone;
    }
  } looker(*this, ray.depth);
  if (ray.ambientLevel == 1) {
    V3f mean;
    if (!field.findSecond(place, fieldReader_, looker, mean)) return false;
    for (int c = 0; c < 3; ++c) ray.value[c] += coefficient[c] * mean[c];
    return true;
  }
  GatheredLight light;
  if (!field.find(place, fieldReader_, looker, light)) return false;
  const double upright = normal.dot(trueNormal);
  const V3f aslant(normal - upright * trueNormal);
  for (int c = 0; c < 3; ++c) {
    const double mean = light.mean[c], tilted = upright * mean + light.perTilt[c].dot(aslant);
    ray.value[c] += coefficient[c] * std::clamp(tilted, .05 * mean, 3 * mean);
  }
  return true;
}

SiteLooker::Surroundings PathTracer::survey(const GatherSite& site, double farthest) {
  V3d x, y;
  frame(site.normal, x, y);
  SiteLooker::Surroundings standing{};
  for (int k = 0; k < SiteLooker::kAzimuths; ++k) {
    const double angle = 2 * kPi * k / SiteLooker::kAzimuths;
    const V3d along = std::cos(angle) * x + std::sin(angle) * y;
    double free = farthest;
    for (const double height : kSurveyHeights) {
      const V3d direction = (along + height * site.normal).normalized();
      const double cosine = direction.dot(along);
      const Hit hit = t_.tracer().nearest(site.point, direction, free / cosine);
      if (hit.surface == kNone) continue;
      free = hit.distance * cosine;
      standing[k] = static_cast<float>(1 / free);
    }
  }
  return standing;
}

double PathTracer::reach(const GatherSite& site, double nearest) {
  // By projected solid angle, in the frame of the site.
  static const auto directions = [] {
    const HemisphereCells cells(kReachRays);
    std::array<V3d, kReachRays> of;
    for (int i = 0; i < kReachRays; ++i)
      of[i] = cells.direction(i, .5, .5, V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1));
    return of;
  }();
  V3d x, y;
  frame(site.normal, x, y);
  double inverse = 0;
  for (const V3d& d : directions) {
    const Hit hit = t_.tracer().nearest(site.point, d.x * x + d.y * y + d.z * site.normal);
    if (hit.surface != kNone) inverse += 1 / std::max(hit.distance, nearest);
  }
  return inverse > 0 ? kReachRays / inverse : kFarAway;
}

// What a site of the field gets. depth: of the ray that asks; nothing but the limit of nesting depends on it.
GatheredLight PathTracer::gather(const GatherSite& site, LightOf of, double share, uint64_t seed, int depth) {
  const RayOptions& o = t_.options();
  const Random before = random_;
  const BrightSpots* const spots = std::exchange(spots_, t_.spots());
  RayObserver observer = std::move(observer_);
  observer_ = nullptr;

  Ray root;
  root.medium = t_.medium();
  root.point = site.point;
  root.normal = site.normal;
  root.length = 0;
  root.depth = depth;
  root.ambientLevel = of == LightOf::second;
  V3d x, y;
  frame(site.normal, x, y);
  // No more directions than can be followed: those below the weight limit would mostly end.
  const double ratio =
      std::min<double>(kMoreRays, static_cast<double>(o.ambientSuperSamples) / o.ambientDivisions);
  const double divisions = std::min(o.ambientDivisions * share, 1 / (o.weightLimit * (1 + ratio)));
  const HemisphereCells cells(static_cast<int>(std::max(
      divisions, of == LightOf::second ? kLeastOfSecond : std::min<double>(o.ambientDivisions, kLeastRays))));
  const int count = cells.count();
  std::vector<Rgb> radiance(count, Rgb(0, 0, 0));
  std::vector<double> distance(count, kFarAway);
  std::vector<int> rays(count, 1);
  const auto send = [&](int cell, uint64_t number) {
    random_ = Random(mixBits(seed ^ number * 0x9e3779b97f4a7c15u));
    const double u1 = random_.uniform(), u2 = random_.uniform();
    Rgb coefficient = Rgb(1, 1, 1) / count;
    Ray child;
    child.direction = cells.direction(cell, u1, u2, x, y, site.normal);
    if (!continueRay(child, kReflectedAmbient, root, coefficient)) return;
    ++child.ambientLevel;
    evaluate(child);
    radiance[cell] += child.value * coefficient * count;
    distance[cell] = std::min(distance[cell], apparentLength(child));
  };
  for (int i = 0; i < count; ++i) send(i, i);
  const int more = static_cast<int>(divisions * ratio);
  if (more > 0) {
    std::vector<double> bright(count);
    for (int i = 0; i < count; ++i) bright[i] = brightness(radiance[i]);
    const std::vector<int> again = cells.refinement(bright, more);
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < again[i]; ++k) send(i, static_cast<uint64_t>(count) * (k + 1) + i);
      rays[i] += again[i];
      radiance[i] /= rays[i];
    }
  }
  random_ = before;
  spots_ = spots;
  observer_ = std::move(observer);
  return cells.sum(radiance, rays, distance, t_.field()->finestSpacing() / 2, x, y);
}

}  // namespace rsphere
