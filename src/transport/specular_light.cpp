#include "transport/specular_light.h"

#include <algorithm>

#include "rays/ray_functions.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// The weight below which sharp paths of an indirect ray are subject to Russian roulette.
double leastWeight(const PathSettings& settings, const PathContext& ray) {
  return std::max(tuning::SpecularLight::kWeakBranch * ray.weight,
                  isOfGather(settings, ray) ? 1 / tuning::RayLimits::kMostDescendants : 0);
}

}  // namespace

void SpecularLight::add(const RayEnd& end, const SharpPaths& sharp, RayResult& result) {
  const bool isShadow = end.context.kinds & kShadow;
  const bool causticsCount = t_.options().caustics || (end.context.kinds & (kAmbient | kSpecular));
  for (const SharpPath& path : sharp) {
    if (path.kind == kReflected && (isShadow || !(causticsCount || path.imagesLamps))) continue;
    if (isBlack(path.coefficient)) continue;
    NextRay next(end, path.kind, path.coefficient);
    if (!goesOnAlong(next, t_, state_)) continue;
    if (!isShadow && end.context.ambientLevel > 0 &&
        !survives(state_.random, leastWeight(settings_, end.context), next))
      continue;
    next.query.direction = path.direction;
    if (path.entersMedium) next.context.space.medium = path.medium;
    RayResult seen = follower_.follow(next.query, next.context);
    seen.value *= next.coefficient;
    result.value += seen.value;
    if (path.kind == kReflected) {
      result.mirrored = seen.value;
      result.mirroredLength = end.hit.length + (path.lengthCounts ? apparentLength(seen) : 0);
    } else if (path.lengthCounts) {
      result.unmirroredLength = end.hit.length + apparentLength(seen);
    }
  }
}

void SpecularLight::add(const RayEnd& end, const Redirects& redirects, RayResult& result) {
  for (const SharpPath& path : redirects.paths) {
    if (isBlack(path.coefficient)) continue;
    NextRay next(end, path.kind, path.coefficient);
    if (!goesOnAlong(next, t_, state_)) continue;
    next.query.direction = path.direction;
    const RayResult seen = follower_.follow(next.query, next.context);
    result.value += seen.value * next.coefficient;
    if (path.lengthCounts) result.unmirroredLength = end.hit.length + apparentLength(seen);
  }
}

void SpecularLight::add(const RayEnd& end, const Relays& relays, RayResult& result) {
  const SharpPath& path = relays.path;
  NextRay next(end, path.kind, path.coefficient);
  if (!goesOnAlong(next, t_, state_)) return;
  next.query.aimedAt = t_.lights().all()[end.ray.aimedAt].relayed;
  next.query.direction = path.direction.normalized();
  result.value += follower_.follow(next.query, next.context).value * next.coefficient;
}

void SpecularLight::addLobe(const RayEnd& end, RayKind kind, const Lobe& lobe, LobeSampler draw,
                            const LobeShare* share, RayResult& result) {
  const RayOptions& o = t_.options();
  const double spread = o.specularSampling;
  int samples =
      samplesOf(settings_, end.context, std::max<double>(spread > 1.5 ? spread : 1, lobe.leastSamples));
  if (lobe.share > 0 && o.weightLimit > 0)
    samples = std::max(
        1, static_cast<int>(std::min<double>(samples, lobe.share * end.context.weight / o.weightLimit)));
  for (int i = 0; i < samples; ++i) {
    const LobeSample sample = draw(i, samples);
    if (isBlack(sample.coefficient)) continue;
    NextRay next(end, kind, sample.coefficient);
    if (!goesOnAlong(next, t_, state_)) continue;
    next.query.direction = sample.direction;
    next.query.origin += lobe.offset;
    RayEnd seen(next.query, next.context);
    Radiance value = follower_.follow(seen).value;
    if (share && seen.hit.surface != kNone) value += (*share)(seen);
    result.value += value * next.coefficient;
  }
}

}  // namespace rsphere
