// What lies between surfaces: media that absorb and scatter, and antimatter that takes surfaces away.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "transport/path_tracer.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

constexpr int kMostSteps = 16;  // samples of one source along a ray, RADIANCE's own figure

// Henyey and Greenstein's phase function times 4 pi; isotropic for g <= 0, as RADIANCE has it.
double phase(double g, double cosine) {
  if (g <= kNegligible) return 1;
  const double d = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (d * std::sqrt(d));
}

// What is left of an extinction when a mist's own is taken off again: not below the medium around everything.
double without(double extinction, double mist, double around) {
  const double rest = extinction - mist;
  return rest < around + 1e-12 * mist ? around : rest;
}

}  // namespace

// ---- which sources are scattered

std::optional<uint32_t> Transport::sourceNamed(std::string_view name) const {
  const auto all = lights_.all();
  for (size_t i = all.size(); i-- > 0;) {
    std::string_view rest = name;
    const LightSource* light = &all[i];
    for (; light->isVirtual(); light = &all[static_cast<size_t>(light->relayed)]) {
      const size_t end = rest.find('>');
      if (end == rest.npos || rest.substr(0, end) != scene_.surfaceName(scene_.surfaces[light->surface]))
        break;
      rest.remove_prefix(end + 1);
    }
    if (!light->isVirtual() && rest == scene_.surfaceName(scene_.surfaces[light->surface]))
      return static_cast<uint32_t>(i);
  }
  return std::nullopt;
}

void Transport::findScatterers(const rad::Warn& warn) {
  for (const Modifier& m : scene_.modifiers) {
    const auto* material = std::get_if<Material>(&m.content);
    const auto* mist = material ? std::get_if<Mist>(material) : nullptr;
    if (!mist) continue;
    if (scatterersOf_.size() <= mist->number) scatterersOf_.resize(mist->number + 1);
    auto& own = scatterersOf_[mist->number];
    for (const std::string& name : mist->sources) {
      const auto source = sourceNamed(name);
      if (!source) {
        // With goals in the scene every lamp is dark.
        if (warn && !scene_.importance)
          warn(fmt::format("{}: unknown source \"{}\"", scene_.place(m.primitive), rad::printable(name)));
        continue;
      }
      auto found = std::find(scatterers_.begin(), scatterers_.end(), *source);
      if (found == scatterers_.end()) found = scatterers_.insert(found, *source);
      const auto position = static_cast<uint16_t>(found - scatterers_.begin());
      if (std::find(own.begin(), own.end(), position) == own.end()) own.push_back(position);
    }
    if (scatterers_.size() > UINT16_MAX)
      throw rad::Error(scene_.place(m.primitive) + ": more than 65535 light sources are scattered");
  }
}

// ---- media

// What the medium does to the ray's radiance on its way: besides what it takes, it adds indirect light, even
// from everywhere (-av), and light of the sources that mist names.
void PathTracer::participate(Ray& ray) {
  const Medium& medium = ray.medium;
  if (!isMedium(medium.extinction)) return;
  const Rgb passed = passedBy(ray);
  ray.value *= passed;
  if ((ray.kinds & kShadow) || !(maxChannel(medium.albedo) > kNegligible)) return;
  ray.value += medium.albedo * t_.options().ambientValue * (Rgb(1, 1, 1) - passed);
  addScattered(ray);
}

// Light from the sources that is scattered once, into the ray, at a point in every step of it (-ms).
void PathTracer::addScattered(Ray& ray) {
  if (ray.scatterers.count == 0 || ray.length >= .99 * kFarAway || ray.medium.eccentricity >= 1 - kNegligible)
    return;
  const double stepLength = t_.options().mediumSampling;
  const int steps = stepLength > kNegligible
                        ? static_cast<int>(std::clamp(ray.length / stepLength + .5, 1., double{kMostSteps}))
                        : 1;
  // Where the light is scattered, as a ray that ends there.
  Ray at;
  at.direction = ray.direction;
  at.medium = ray.medium;
  at.scatterers = ray.scatterers;
  at.mist = ray.mist;
  at.kinds = 0;
  at.depth = ray.depth;
  at.pathLength = ray.pathLength;
  at.contribution = ray.contribution;
  at.cosine = 0;  // no surface's front or back
  const Rgb scattered = ray.medium.extinction * ray.medium.albedo * (ray.length / steps / (4 * kPi));
  for (const uint16_t scatterer : ray.scatterers)
    for (int i = 0; i < steps; ++i) {
      at.length = ray.length * (i + random_.uniform()) / steps;
      const Rgb passed = passing(ray.medium.extinction, at.length);
      if (maxChannel(passed) <= kNegligible * kNegligible) break;
      at.point = ray.origin + at.length * ray.direction;
      samples_.clear();
      t_.lights().sample(t_.scatterers()[scatterer], at.point, {0, t_.options().directJitter}, random_,
                         samples_);
      for (const SourceSample& sample : samples_) {
        const double toRay =
            sample.solidAngle * phase(ray.medium.eccentricity, ray.direction.dot(sample.direction));
        const Rgb coefficient = scattered * passed * toRay;
        const Rgb unobstructed = sourceValue(at, sample);
        Rgb value;
        if (isBlack(unobstructed) || !arrives(at, {&sample, coefficient, unobstructed}, value)) continue;
        ray.value += value * coefficient;
      }
    }
}

// A ray that enters or leaves a volume of mist.
bool PathTracer::shadeMaterial(Ray& ray, const Mist& mist, int32_t behind) {
  Rgb extinction = mist.extinction;
  if (!isBlack(extinction)) {
    applyModifiers(ray, behind);
    extinction *= ray.pattern;
  }
  const auto& sources = t_.scatterersOf(mist);
  const auto addTo = [&](Ray& r) {
    r.medium.extinction += extinction;
    if (mist.hasAlbedo) r.medium.albedo = mist.albedo;
    if (mist.hasEccentricity) r.medium.eccentricity = mist.eccentricity;
    for (const uint16_t s : sources)
      if (!r.scatterers.add(s))
        throw rad::Error(fmt::format("more than {} light sources are scattered in the mists around a point",
                                     ScatteringSources::kMost));
  };
  Ray child;
  inherit(child, ray, kTransmitted);
  if (ray.cosine > 0) {
    addTo(child);
    child.mist = &ray;
  } else {
    size_t removed = 0;
    for (const uint16_t s : sources) removed += child.scatterers.remove(s);
    // It began inside.
    if (removed < sources.size()) addTo(ray);
    const Medium around = t_.medium();
    const Medium& before = ray.mist ? ray.mist->medium : around;
    for (int i = 0; i < 3; ++i)
      child.medium.extinction[i] = without(ray.medium.extinction[i], extinction[i], around.extinction[i]);
    if (mist.hasAlbedo) child.medium.albedo = before.albedo;
    if (mist.hasEccentricity) child.medium.eccentricity = before.eccentricity;
    child.mist = ray.mist ? ray.mist->mist : nullptr;
  }
  passOn(child, ray);
  return true;
}

// ---- antimatter

bool PathTracer::shadeMaterial(Ray& ray, const Antimatter& antimatter, int32_t) {
  if (ray.cosine > 0)
    ray.clipsBeyond = ray.clips | antimatter.clips;
  else
    ray.clipsBeyond = ray.clips & ~antimatter.clips;
  if (antimatter.cut.kind == Alternate::Kind::modifier) {
    // Whether the ray has gone into one of the volumes that it was blind to: then it meets the cut here.
    int inside = 0;
    for (const Ray* r = &ray; r->parent; r = r->parent) {
      const Ray& before = *r->parent;
      if ((r->kind & kReflections) || before.surface == kNone ||
          !(t_.scene().surfaces[before.surface].clip & antimatter.clips))
        continue;
      inside += hitFront(before) ? 1 : -1;
    }
    if (inside > 0) {
      // The material is on the other side of the antimatter's surface: a dielectric is left here, not
      // entered.
      flip(ray);
      ray.insideOut = !ray.insideOut;
      return shade(ray, antimatter.cut.modifier);
    }
  }
  pass(ray);
  return true;
}

}  // namespace rsphere
