// Light that comes by way of other surfaces: sharp paths, sampled lobes, the hemisphere.
#include <algorithm>
#include <cmath>

#include "scene/even_sequence.h"
#include "transport/path_tracer.h"
#include "transport/radiance_guess.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

// Whether no direction of light is far brighter than others: the peak of a lobe, share / (4 pi alpha^2) at
// normal incidence, against what is diffuse, share / pi.
bool isEven(const Scattering& s) {
  constexpr double kMost = 4;
  return maxChannel(s.specularReflection + s.specularTransmission) <=
         kMost * 4 * s.alpha2 * maxChannel(s.diffuseReflection + s.diffuseTransmission);
}

}  // namespace

bool PathTracer::shadeBoundary(Ray& ray, const Scattering& scattering) {
  ray.medium = scattering.medium;
  followSharp(ray, scattering.sharp);
  return true;
}

bool PathTracer::shadeDiffusing(Ray& ray, const Scattering& scattering, const Interaction& at) {
  followSharp(ray, scattering.sharp);
  if (ray.kinds & kShadow) return true;
  sampleLobes(ray, scattering, at);
  if (maxChannel(scattering.ambientReflection) > kNegligible)
    addIndirect(ray, scattering.normal, at.normal, kReflectedAmbient, scattering.ambientReflection);
  if (maxChannel(scattering.ambientTransmission) > kNegligible)
    addIndirect(ray, -scattering.normal, -at.normal, kTransmittedAmbient, scattering.ambientTransmission);
  if (!isBlack(scattering.diffuseReflection) || !isBlack(scattering.diffuseTransmission) ||
      !isBlack(scattering.specularReflection) || !isBlack(scattering.specularTransmission)) {
    const bool transmits =
        !isBlack(scattering.diffuseTransmission) || !isBlack(scattering.specularTransmission);
    const auto coefficientOf = [&, jitter = t_.options().directJitter](const V3d& toSource,
                                                                       double solidAngle) {
      return directCoefficient(scattering, at, toSource, solidAngle, jitter);
    };
    const V3d front = transmits ? V3d(0, 0, 0) : scattering.normal;
    if (t_.options().chosenSources > 0 && isEven(scattering))
      addDirectOfChosen(ray, coefficientOf, front);
    else
      addDirect(ray, coefficientOf, front);
  }
  return true;
}

void PathTracer::followSharp(Ray& ray, const SharpPaths& sharp) {
  for (const SharpPath& path : sharp) {
    if ((ray.kinds & kShadow) && path.kind == kReflected) continue;
    Ray child;
    Rgb coefficient = path.coefficient;
    if (isBlack(coefficient) || !continueRay(child, path.kind, ray, coefficient)) continue;
    child.direction = path.direction;
    if (path.entersMedium) child.medium = path.medium;
    evaluate(child);
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

void PathTracer::sampleLobes(Ray& ray, const Scattering& scattering, const Interaction& at) {
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

// How many samples a ray takes of a lobe of which a ray of weight 1 takes `wanted`.
int PathTracer::samplesOf(const Ray& ray, double wanted) const {
  if (isOfGather(ray)) return 1;
  return std::max(1, static_cast<int>(wanted * ray.weight + .5));
}

// share: of the lobe in the ray's radiance, what the weights of its directions are 1 in the mean of.
// least: the number that a ray of weight 1 gets whatever -ss is.
void PathTracer::sampleLobe(Ray& ray, RayKind kind, const Rgb& share, LobeSampler draw, int least) {
  const double spread = t_.options().specularSampling;
  const double wanted = std::max<double>(spread > 1.5 ? spread : 1, least);
  const int samples = samplesOf(ray, wanted);
  for (int i = 0; i < samples; ++i) {
    Ray child;
    const double u1 = (i + random_.uniform()) / samples, u2 = random_.uniform();
    const double weight = draw(u1, u2, child.direction);
    if (!(weight > 0)) continue;
    Rgb coefficient = share * (weight / samples);
    if (!continueRay(child, kind, ray, coefficient)) continue;
    evaluate(child);
    ray.value += child.value * coefficient;
  }
}

// Not where the ray's own descendants are cut off by -lr, rather than by chance: what is guessed would be
// more than is followed.
int PathTracer::raysToGuess(const Ray& ray) const {
  const int limit = t_.options().reflectionLimit;
  if (!guess_ || limit > 0 || (limit < 0 && ray.level + 1 > -limit)) return 0;
  return guess_->raysToGuess(ray.ambientLevel);
}

void PathTracer::addIndirect(Ray& ray, const V3d& normal, const V3d& trueNormal, RayKind kind,
                             const Rgb& coefficient) {
  const RayOptions& o = t_.options();
  if (o.ambientDivisions <= 0 || ray.ambientLevel >= o.ambientBounces || !t_.isAmbient(ray.surface)) {
    ray.value += coefficient * o.ambientValue;
    return;
  }
  const bool interpolating = t_.field() != nullptr;
  if (ray.ambientLevel > 0 && t_.coarse() && addFromPatch(ray, normal, trueNormal, coefficient)) return;
  if (ray.ambientLevel == 0 && interpolating && addInterpolated(ray, normal, trueNormal, coefficient)) return;
  const int guesses = raysToGuess(ray);
  if (interpolating && guesses == 0) {
    const double rays =
        ray.ambientLevel > 0 ? 1 : (o.ambientDivisions + o.ambientSuperSamples) * std::min(ray.weight, 1.);
    gatherHemisphere(ray, normal, trueNormal, kind, std::max(1, static_cast<int>(rays + .5)),
                     [&](Ray& child, double part) {
                       const Rgb c = coefficient * part;
                       child.contribution = ray.contribution * passedBy(ray) * c;
                       evaluate(child);
                       if (linking_)
                         linking_->addLight(child.ambientLevel - 1, child.value * child.contribution);
                       else
                         ray.value += child.value * c;
                     });
    return;
  }
  int side = 1;
  if (ray.ambientLevel == 0) {
    double divisions = (o.ambientDivisions + o.ambientSuperSamples) * std::min(ray.weight, 1.);
    // No more directions than can be followed: each would fall below the weight limit and most of them end.
    if (!interpolating)
      divisions =
          std::min(divisions, (o.ambientDivisions + o.ambientSuperSamples) * .8 * maxChannel(coefficient) *
                                  ray.weight / (o.ambientDivisions * o.weightLimit + 1e-20));
    side = std::max(1, static_cast<int>(std::sqrt(divisions) + .5));
  }
  V3d x, y;
  frame(normal, x, y);
  BrightSpots::Aim aim;
  if (spots_) spots_->aim(ray.point, normal, aim);
  // Of the cell (i, j), for even u1, u2, u3. Answers what the direction counts, against one that is not
  // aimed; 0: it leads nowhere.
  const auto draw = [&](int i, int j, double u1, double u2, double u3, V3d& direction) {
    if (u3 < aim.share) {
      direction = spots_->sample(aim, u3 / aim.share, u1, u2);
    } else {
      // By projected solid angle, so that every direction counts the same (Malley's method).
      const double radius = std::sqrt((i + u1) / side), angle = 2 * kPi * (j + u2) / side;
      const double height = std::sqrt(std::max(0., 1 - radius * radius));
      direction = radius * std::cos(angle) * x + radius * std::sin(angle) * y + height * normal;
    }
    const double cosine = direction.dot(normal);
    if (cosine <= 0 || direction.dot(trueNormal) <= 0) return 0.;
    if (!(aim.share > 0)) return 1.;
    return 1 / (1 - aim.share + aim.share * kPi / cosine * spots_->density(aim, direction));
  };
  const Rgb share = coefficient / (static_cast<double>(side) * side);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      if (guesses > 0) {
        const double shift3 = random_.uniform(), shift1 = random_.uniform(), shift2 = random_.uniform();
        Rgb sum(0, 0, 0);
        for (int k = 0; k < guesses; ++k) {
          V3d direction;
          const Imath::V2d u = evenly(static_cast<size_t>(k), shift1, shift2);
          const double part = draw(i, j, u.x, u.y, (k + shift3) / guesses, direction);
          if (part > 0) sum += part * guess_->indirect(ray.point, direction, ray.surface);
        }
        ray.value += share * sum / static_cast<double>(guesses);
      }
      Ray child;
      const double u3 = aim.share > 0 ? random_.uniform() : 1;
      const double u1 = random_.uniform(), u2 = random_.uniform();
      const double part = draw(i, j, u1, u2, u3, child.direction);
      if (!(part > 0)) continue;
      Rgb c = interpolating ? Rgb(kMeanReflectance, kMeanReflectance, kMeanReflectance) : share;
      if (!continueRay(child, kind, ray, c)) continue;
      if (interpolating) c *= share / kMeanReflectance;
      // Only now: what is aimed has less of a share because it brings more, and is not to end for it.
      c *= part;
      child.contribution = ray.contribution * passedBy(ray) * c;
      ++child.ambientLevel;
      evaluate(child);
      ray.value += child.value * c;
      if (guesses > 0) ray.value -= guess_->indirect(child) * c;
    }
}

}  // namespace rsphere
