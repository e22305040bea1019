#include "transport/specular_light.h"

#include <algorithm>

#include "transport/ray_functions.h"
#include "transport/ray_limits.h"

namespace rsphere {
namespace {

// The weight below which sharp paths of a gather's rays are followed by Russian roulette, with a probability
// in proportion to their weight. Gathers begin with a weight of 1/2, so that one of their rays has at most 32
// descendants at a time on average. Without a limit their number doubles at each surface of nested transparent
// objects, up to -lr. The reflections of a pane of glass, 1/12 of the light, remain above it.
constexpr double kWeakPath = 1. / 64;

// Whether the path of a child goes on. If so, its weight is at least kWeakPath, and its coefficient makes up
// for the paths that do not go on.
bool survives(Random& random, Ray& child, Rgb& coefficient) {
  const double probability = child.weight / kWeakPath;
  if (probability >= 1) return true;
  if (random.uniform() >= probability) return false;
  coefficient /= probability;
  child.contribution /= probability;
  child.weight = kWeakPath;
  return true;
}

}  // namespace

void SpecularLight::follow(Ray& ray, const SharpPaths& sharp) {
  const bool roulette = !(ray.kinds & kShadow) && isOfGather(t_, ray);
  for (const SharpPath& path : sharp) {
    if ((ray.kinds & kShadow) && path.kind == kReflected) continue;
    Ray child;
    Rgb coefficient = path.coefficient;
    if (isBlack(coefficient) || !continueRay(t_, state_.random, child, path.kind, ray, coefficient)) continue;
    if (roulette && !survives(state_.random, child, coefficient)) continue;
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

void SpecularLight::sampleLobes(Ray& ray, const Scattering& scattering, const Interaction& at) {
  const double spread = t_.options().specularSampling;
  if (scattering.sampleReflection)
    sampleLobe(ray, kReflectedSpecular, scattering.specularReflection, [&](double u1, double u2, V3d& d) {
      return sampleReflection(scattering, at, spread, u1, u2, d);
    });
  if (scattering.sampleTransmission)
    sampleLobe(ray, kTransmittedSpecular, scattering.specularTransmission, [&](double u1, double u2, V3d& d) {
      return sampleTransmission(scattering, at, spread, u1, u2, d);
    });
}

void SpecularLight::sampleLobe(Ray& ray, RayKind kind, const Rgb& share, LobeSampler draw, int least) {
  const double spread = t_.options().specularSampling;
  const double wanted = std::max<double>(spread > 1.5 ? spread : 1, least);
  const int samples = samplesOf(t_, ray, wanted);
  for (int i = 0; i < samples; ++i) {
    Ray child;
    const double u1 = (i + state_.random.uniform()) / samples, u2 = state_.random.uniform();
    const double weight = draw(u1, u2, child.direction);
    if (!(weight > 0)) continue;
    Rgb coefficient = share * (weight / samples);
    if (!continueRay(t_, state_.random, child, kind, ray, coefficient)) continue;
    follower_.follow(child);
    ray.value += child.value * coefficient;
  }
}

}  // namespace rsphere
