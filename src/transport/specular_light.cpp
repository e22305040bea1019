#include "transport/specular_light.h"

#include <algorithm>

#include "transport/ray_functions.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::SpecularLight;

// The weight below which sharp paths of an indirect ray are followed by Russian roulette.
double leastWeight(const PathSettings& settings, const Ray& ray) {
  return std::max(Tuning::kWeakBranch * ray.weight, isOfGather(settings, ray) ? Tuning::kWeakPath : 0);
}

}  // namespace

void SpecularLight::follow(Ray& ray, const SharpPaths& sharp) {
  for (const SharpPath& path : sharp) {
    if ((ray.kinds & kShadow) && path.kind == kReflected) continue;
    Ray child;
    Coefficient coefficient = path.coefficient;
    if (isBlack(coefficient) || !continueRay(t_, state_, child, path.kind, ray, coefficient)) continue;
    if (!(ray.kinds & kShadow) && ray.ambientLevel > 0 &&
        !survives(state_.random, leastWeight(settings_, ray), child, coefficient))
      continue;
    child.direction = path.direction;
    if (path.entersMedium) child.medium = path.medium;
    follower_.follow(child);
    child.value *= coefficient;
    ray.value += child.value;
    if (path.kind == kReflected) {
      ray.mirrored = child.value;
      ray.mirroredLength = ray.length + (path.lengthCounts ? apparentLength(child) : 0);
    } else if (path.lengthCounts) {
      ray.unmirroredLength = ray.length + apparentLength(child);
    }
  }
}

void SpecularLight::redirect(Ray& ray, const SharpPaths& redirected) {
  for (const SharpPath& path : redirected) {
    Ray child;
    Coefficient coefficient = path.coefficient;
    if (isBlack(coefficient) || !continueRay(t_, state_, child, path.kind, ray, coefficient)) continue;
    child.direction = path.direction;
    follower_.follow(child);
    ray.value += child.value * coefficient;
    if (path.lengthCounts) ray.unmirroredLength = ray.length + apparentLength(child);
  }
}

void SpecularLight::relay(Ray& ray, const SharpPath& path) {
  Ray child;
  Coefficient coefficient = path.coefficient;
  if (!continueRay(t_, state_, child, path.kind, ray, coefficient)) return;
  child.aimedAt = t_.lights().all()[ray.aimedAt].relayed;
  child.unobstructed = ray.unobstructed;
  child.direction = path.direction.normalized();
  follower_.follow(child);
  ray.value += child.value * coefficient;
}

void SpecularLight::sampleLobe(Ray& ray, RayKind kind, const Lobe& lobe, LobeSampler draw,
                               const LobeShare* share) {
  const RayOptions& o = t_.options();
  const double spread = o.specularSampling;
  int samples = samplesOf(settings_, ray, std::max<double>(spread > 1.5 ? spread : 1, lobe.leastSamples));
  if (lobe.share > 0 && o.weightLimit > 0)
    samples =
        std::max(1, static_cast<int>(std::min<double>(samples, lobe.share * ray.weight / o.weightLimit)));
  for (int i = 0; i < samples; ++i) {
    const LobeSample sample = draw(i, samples);
    Coefficient coefficient = sample.coefficient;
    Ray child;
    if (isBlack(coefficient) || !continueRay(t_, state_, child, kind, ray, coefficient)) continue;
    child.direction = sample.direction;
    child.origin += lobe.offset;
    follower_.follow(child);
    if (share && child.surface != kNone) child.value += (*share)(child);
    ray.value += child.value * coefficient;
  }
}

}  // namespace rsphere
