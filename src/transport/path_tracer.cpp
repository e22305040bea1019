#include "transport/path_tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNegligible = 1e-6;  // shares of light below it are not followed; RADIANCE's own figure

// A white diffuse surface whose radiance is pi times the mean of what it receives: the irradiance (-i, -I).
const Opaque kIrradianceMeter{Rgb(kPi, kPi, kPi), 0, 0, false};
constexpr double kMeterLength =
    1e-5;  // -I: world units from the ray's origin to its imagined surface, as rtrace

// A ray whose direction changed by less on its way through panes has gone straight on.
constexpr double kStraight = 1e-9;

bool isBlack(const Rgb& c) { return !(maxChannel(c) > 0); }

// How far what is seen along the ray seems to be: the mirrored image where it is most of the light.
double apparentLength(const Ray& ray) {
  return brightness(ray.mirrored) > .5 * brightness(ray.value) ? ray.mirroredLength : ray.unmirroredLength;
}

// Rays are traced one inside the other. The deepest takes about 8 MB of stack, what a thread has.
constexpr int kDeepest = 4000;
void checkDepth(const Ray& ray) {
  if (ray.depth > kDeepest)
    throw rad::Error(fmt::format("a ray goes through more than {} surfaces one after the other", kDeepest));
}

// Rounded once: where a plane lies at 0, what is left of the coordinate tells on which side of it the point
// is, and function files with floor() in them ask.
V3d along(const V3d& origin, double distance, const V3d& direction) {
  return V3d(std::fma(distance, direction.x, origin.x), std::fma(distance, direction.y, origin.y),
             std::fma(distance, direction.z, origin.z));
}

void turnRound(Ray& ray) {
  if (ray.cosine >= 0) return;
  ray.cosine = -ray.cosine;
  ray.normal = -ray.normal;
  ray.perturbation = -ray.perturbation;
  ray.fromBehind = !ray.fromBehind;
}

// The share of light that a medium lets through.
Rgb passing(const Rgb& extinction, double length) {
  if (isBlack(extinction)) return Rgb(1, 1, 1);
  return Rgb(std::exp(-extinction.x * length), std::exp(-extinction.y * length),
             std::exp(-extinction.z * length));
}

bool beyondReach(const Glow* glow, double distance) {
  return glow && glow->reach >= -kNegligible && distance > glow->reach;
}

}  // namespace

Transport::Transport(const Scene& scene, const RayOptions& options, Irradiance irradiance, bool basicRadiance,
                     rad::Warn warn)
    : scene_(scene),
      options_(options),
      irradiance_(irradiance),
      basicRadiance_(basicRadiance),
      tracer_(scene, options.backFacesVisible),
      lights_(scene),
      functions_(scene, std::move(warn)),
      lightOf_(scene.surfaces.size(), kNone) {
  for (size_t i = 0; i < lights_.all().size(); ++i)
    lightOf_[lights_.all()[i].surface] = static_cast<int32_t>(i);
  for (size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& s = scene.surfaces[i];
    const Material* material = scene.materialOf(s);
    if (scene.importance || !std::holds_alternative<Distant>(s.shape) || !material) continue;
    const auto radiance = sourceRadiance(*material);
    if (radiance && maxChannel(*radiance) > kNegligible) distant_.push_back(static_cast<int32_t>(i));
  }
  const bool including = !options.ambientIncluded.empty();
  const auto& names = including ? options.ambientIncluded : options.ambientExcluded;
  if (names.empty()) return;
  ambient_.resize(scene.surfaces.size());
  for (size_t i = 0; i < scene.surfaces.size(); ++i)
    ambient_[i] = (std::find(names.begin(), names.end(), scene.modifierName(scene.surfaces[i])) !=
                   names.end()) == including;
}

Ray PathTracer::trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed) {
  random_ = Random(seed);
  primaryDirection_ = direction;
  shownSource_ = kNone;
  Ray ray;
  ray.extinction = t_.options().mediumExtinction;
  ray.origin = origin;
  ray.direction = direction;
  if (t_.irradiance() == Irradiance::point) {
    ray.length = ray.unmirroredLength = kMeterLength;
    ray.point = origin + kMeterLength * direction;
    ray.normal = -direction;
    shadeMaterial(ray, kIrradianceMeter, kNone);
    return ray;
  }
  ray.farthest = farthest;
  evaluate(ray);
  return ray;
}

Ray PathTracer::cast(const V3d& origin, const V3d& direction, double farthest) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.farthest = farthest;
  findHit(ray);
  return ray;
}

// ---- rays

// Makes child a descendant of parent, or returns false where the path ends. coefficient: of the child's
// radiance in the parent's; raised where the path survived Russian roulette, so that the mean stays right.
bool PathTracer::continueRay(Ray& child, RayKind kind, const Ray& parent, Rgb& coefficient) {
  const RayOptions& o = t_.options();
  child.origin = parent.point;
  child.kind = kind;
  child.kinds = parent.kinds | kind;
  child.level = parent.level;
  child.ambientLevel = parent.ambientLevel;
  child.depth = parent.depth + 1;
  child.pathLength = parent.pathLength + parent.length;
  if (parent.kinds & kShadow) child.shadowLength = parent.shadowLength + parent.length;
  child.extinction = parent.extinction;
  if (kind & kReflections) {
    ++child.level;
    child.farthest = 0;
  } else {
    child.aimedAt = parent.aimedAt;
    child.farthest = parent.farthest > kSamePlace ? parent.farthest - parent.length : 0;
  }
  child.weight = parent.weight * std::min(1., maxChannel(coefficient));
  const double depth = maxChannel(parent.extinction) * parent.length;
  if (depth > .1) child.weight *= std::exp(-depth);
  if (!(child.weight > 0)) return false;
  if (child.kinds & kShadow) return true;
  if (o.reflectionLimit > 0) return child.weight >= o.weightLimit && child.level <= o.reflectionLimit;
  if (o.reflectionLimit < 0 && child.level > -o.reflectionLimit) return false;
  if (child.weight >= o.weightLimit) return true;
  if (random_.uniform() * o.weightLimit > child.weight) return false;
  coefficient *= o.weightLimit / child.weight;
  child.weight = o.weightLimit;
  return true;
}

void PathTracer::evaluate(Ray& ray) {
  checkDepth(ray);
  findHit(ray);
  if (ray.surface != kNone) shadeHit(ray);
  finish(ray);
}

void PathTracer::findHit(Ray& ray) {
  const Hit hit =
      t_.tracer().nearest(ray.origin, ray.direction, ray.farthest > kSamePlace ? ray.farthest : kFarAway);
  ray.surface = hit.surface;
  ray.point = ray.origin;
  ray.normal = -ray.direction;
  ray.cosine = 1;
  if (hit.surface != kNone) {
    ray.length = hit.distance;
    ray.point = along(ray.origin, hit.distance, ray.direction);
    ray.normal = hit.normal;
    ray.cosine = hit.cosine;
  } else if (!(ray.farthest > kSamePlace)) {
    seesDistant(ray);
  }
}

// A distant source in the ray's direction. The first one that is not glow hides the others; illum that lets
// light pass and glow give way, and glow is what is left.
bool PathTracer::seesDistant(Ray& ray) {
  const Scene& scene = t_.scene();
  const auto sees = [&](int32_t surface) {
    return std::get<Distant>(scene.surfaces[surface].shape).direction.dot(ray.direction) >=
           std::get<Distant>(scene.surfaces[surface].shape).cosHalfAngle;
  };
  if (ray.aimedAt != kNone) {
    const LightSource& light = t_.lights().all()[ray.aimedAt];
    if (light.distant && sees(light.surface)) ray.surface = light.surface;
    return ray.surface != kNone;
  }
  int32_t glow = kNone;
  bool passedIllum = false;
  for (const int32_t s : t_.distant()) {
    if (!sees(s)) continue;
    const Material& material = *scene.materialOf(scene.surfaces[s]);
    if (std::holds_alternative<Glow>(material)) {
      if (glow == kNone) glow = s;
    } else if (const auto* illum = std::get_if<Illum>(&material);
               illum && illum->alternate.kind != Alternate::Kind::modifier) {
      passedIllum = true;
    } else {
      ray.surface = s;
      return true;
    }
  }
  // Indirect rays through a distant illum would count again what it stands for.
  if (passedIllum && (ray.kinds & (kAmbient | kSpecular))) return false;
  ray.surface = glow;
  return glow != kNone;
}

void PathTracer::shadeHit(Ray& ray) {
  ray.unmirroredLength = ray.length;
  if (shadeSurface(ray)) return;
  if (std::holds_alternative<Distant>(t_.scene().surfaces[ray.surface].shape)) return;
  pass(ray);
}

// What the surface emits and scatters; false where it has no material.
bool PathTracer::shadeSurface(Ray& ray) {
  const Surface& surface = t_.scene().surfaces[ray.surface];
  if (!surface.goal || ray.cosine < 0) return shade(ray, surface.modifier);
  Ray emitted = ray;
  const bool sampled = t_.lightOf(ray.surface) != kNone;
  if (!(sampled && countedByDirect(ray, nullptr))) emit(emitted, Rgb(1, 1, 1), nullptr);
  const bool shaded =
      (ray.kinds & kShadow) && ray.aimedAt == t_.lightOf(ray.surface) ? true : shade(ray, surface.modifier);
  ray.value += emitted.value;
  return shaded;
}

// Shades the ray with a chain of modifiers; false where it has no material.
bool PathTracer::shade(Ray& ray, int32_t modifier) {
  const bool meters = t_.irradiance() == Irradiance::surface && !(ray.kinds & ~(kPrimary | kTransmitted));
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    const auto* material = std::get_if<Material>(&m.content);
    if (!material) {
      if (applyModifier(ray, modifier)) {
        // Nothing shows what a material is mixed from but the mixture itself.
        if (m.next != kNone) throw rad::Error(t_.scene().place(m.primitive) + ": inappropriate modifier");
        return true;
      }
      continue;
    }
    if (meters && isTransparent(*material)) {
      pass(ray);
      return true;
    }
    if (meters && !isLightSource(*material)) {
      ray.pattern = Rgb(1, 1, 1);
      return shadeMaterial(ray, kIrradianceMeter, kNone);
    }
    if (std::visit([&](const auto& kind) { return shadeMaterial(ray, kind, m.next); }, *material))
      return true;
  }
  return false;
}

// What a pattern, texture or mixture does to the ray; whether it has shaded it with a material.
bool PathTracer::applyModifier(Ray& ray, int32_t modifier) {
  const Content& content = t_.scene().modifiers[modifier].content;
  if (const auto* mixture = std::get_if<Mixture>(&content)) return shadeMixture(ray, modifier, *mixture);
  const FunctionPoint at = functionPoint(ray);
  if (std::holds_alternative<Pattern>(content))
    ray.pattern *= t_.functions().pattern(modifier, at, functionScratch_);
  else
    ray.perturbation += t_.functions().texture(modifier, at, functionScratch_);
  return false;
}

// The modifiers of a material: patterns, textures, and mixtures of them.
void PathTracer::applyModifiers(Ray& ray, int32_t modifier) {
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    if (std::holds_alternative<Material>(m.content) || applyModifier(ray, modifier))
      throw rad::Error(t_.scene().place(m.primitive) + ": conflicting material");
  }
}

bool PathTracer::shadeMixture(Ray& ray, int32_t modifier, const Mixture& mixture) {
  const double share = t_.functions().mixture(modifier, functionPoint(ray), functionScratch_);
  if (share < 0) return false;
  struct Side {
    Ray ray;
    double share;
    bool counts, shaded = false;
  };
  Side sides[2] = {{ray, share, share > kNegligible}, {ray, 1 - share, share < 1 - kNegligible}};
  const int32_t chains[2] = {mixture.foreground, mixture.background};
  for (int i = 0; i < 2; ++i) {
    Side& side = sides[i];
    if (!side.counts) continue;
    side.ray.weight *= side.share;
    side.shaded = shade(side.ray, chains[i]);
  }
  // Beside a material void is a hole.
  for (int i = 0; i < 2; ++i)
    if (sides[i].counts && !sides[i].shaded && sides[1 - i].shaded) pass(sides[i].ray);
  const Ray& a = sides[0].ray;
  const Ray& b = sides[1].ray;
  const auto mixed = [&](const auto& x, const auto& y) { return x * share + y * (1 - share); };
  ray.perturbation = mixed(a.perturbation, b.perturbation);
  ray.pattern = mixed(a.pattern, b.pattern);
  if (!sides[0].shaded && !sides[1].shaded) return false;
  ray.value = mixed(a.value, b.value);
  ray.mirrored = mixed(a.mirrored, b.mirrored);
  const double mirroredA = share * brightness(a.mirrored), mirroredB = (1 - share) * brightness(b.mirrored);
  ray.mirroredLength = (mirroredA > mirroredB ? a : b).mirroredLength;
  const double restA = share * brightness(a.value) - mirroredA;
  const double restB = (1 - share) * brightness(b.value) - mirroredB;
  ray.unmirroredLength = (restA > restB ? a : b).unmirroredLength;
  return true;
}

FunctionPoint PathTracer::functionPoint(const Ray& ray) const {
  FunctionPoint at;
  at.direction = ray.direction;
  at.normal = ray.normal;
  at.cosine = ray.cosine;
  at.point = ray.point;
  at.distance = ray.pathLength + ray.length;
  at.shadowDistance = ray.shadowLength + ray.length;
  at.u = ray.u;
  at.v = ray.v;
  return at;
}

// The ray goes on as if it had hit nothing.
void PathTracer::pass(Ray& ray) {
  Ray child;
  child.direction = ray.direction;
  child.origin = ray.point;
  child.kind = kTransmitted;
  child.kinds = ray.kinds | kTransmitted;
  child.level = ray.level;
  child.ambientLevel = ray.ambientLevel;
  child.depth = ray.depth + 1;
  child.pathLength = ray.pathLength + ray.length;
  if (ray.kinds & kShadow) child.shadowLength = ray.shadowLength + ray.length;
  child.extinction = ray.extinction;
  child.aimedAt = ray.aimedAt;
  child.weight = ray.weight;
  double length = ray.length;
  const auto shorten = [&](double by) {
    if (ray.farthest > kSamePlace) child.farthest = std::max(ray.farthest - by, 2 * kSamePlace);
  };
  shorten(length);
  checkDepth(child);
  findHit(child);
  // Surfaces of nothing at all are gone through here, however many there are, rather than one inside the
  // other.
  while (child.surface != kNone && t_.scene().surfaces[child.surface].modifier == kNone &&
         child.length < kFarAway) {
    length += child.length;
    child.pathLength += child.length;
    if (child.kinds & kShadow) child.shadowLength += child.length;
    child.origin = child.point;
    shorten(length);
    child.length = kFarAway;
    findHit(child);
  }
  if (child.surface != kNone) shadeHit(child);
  finish(child);
  ray.value = child.value;
  ray.mirrored = child.mirrored;
  ray.mirroredLength = length + child.mirroredLength;
  ray.unmirroredLength = length + child.unmirroredLength;
}

void PathTracer::finish(Ray& ray) { ray.value *= passing(ray.extinction, ray.length); }

Interaction PathTracer::interaction(const Ray& ray) const {
  Interaction at;
  at.direction = ray.direction;
  const bool behind = ray.cosine < 0;
  at.normal = behind ? -ray.normal : ray.normal;
  at.cosine = std::abs(ray.cosine);
  at.front = behind == ray.fromBehind;
  at.perturbation = behind ? -ray.perturbation : ray.perturbation;
  at.pattern = ray.pattern;
  at.kinds = ray.kinds;
  if (ray.surface != kNone) {
    const Shape& shape = t_.scene().surfaces[ray.surface].shape;
    at.flat = std::holds_alternative<Polygon>(shape) || std::holds_alternative<Ring>(shape);
  }
  return at;
}

// ---- materials

// Plastic, metal and trans are the same from both sides.
template <class M>
bool PathTracer::shadeTwoSided(Ray& ray, const M& material, int32_t behind) {
  if (ray.cosine < 0 && !t_.options().backFacesVisible) {
    pass(ray);
    return true;
  }
  applyModifiers(ray, behind);
  turnRound(ray);
  const Interaction at = interaction(ray);
  return shadeDiffusing(ray, scatter(material, at, t_.options().specularThreshold), at);
}

bool PathTracer::shadeMaterial(Ray& ray, const Opaque& material, int32_t behind) {
  return (ray.kinds & kShadow) || shadeTwoSided(ray, material, behind);
}

bool PathTracer::shadeMaterial(Ray& ray, const Trans& material, int32_t behind) {
  return shadeTwoSided(ray, material, behind);
}

bool PathTracer::shadeMaterial(Ray& ray, const Dielectric& material, int32_t behind) {
  applyModifiers(ray, behind);
  const Interaction at = interaction(ray);
  return shadeBoundary(ray, scatter(material, at, at.front ? ray.extinction : t_.options().mediumExtinction,
                                    t_.basicRadiance()));
}

bool PathTracer::shadeMaterial(Ray& ray, const Interface& material, int32_t behind) {
  applyModifiers(ray, behind);
  return shadeBoundary(ray, scatter(material, interaction(ray), t_.basicRadiance()));
}

bool PathTracer::shadeMaterial(Ray& ray, const Glass& material, int32_t behind) {
  if (ray.cosine <= 0 && !t_.options().backFacesVisible) {
    pass(ray);
    return true;
  }
  applyModifiers(ray, behind);
  turnRound(ray);
  followSharp(ray, scatter(material, interaction(ray)));
  return true;
}

bool PathTracer::shadeMaterial(Ray& ray, const Mirror& material, int32_t behind) {
  const bool aimedHere = ray.aimedAt != kNone && t_.lights().all()[ray.aimedAt].surface == ray.surface;
  if (material.alternate.kind != Alternate::Kind::none && !aimedHere) {
    // An indirect ray that meets the front takes the mirror's way, as the light that it stands for does; only
    // what is transparent is passed even then.
    const bool free = ray.cosine < 0 || !(ray.kinds & (kAmbient | kSpecular));
    const auto transparent = [&] {
      const int32_t m = material.alternate.modifier;
      const Material* other = t_.scene().materialAt(t_.scene().firstMaterial(m));
      return other && isTransparent(*other);
    };
    if (free || transparent()) return useAlternate(ray, material.alternate);
  }
  if (ray.aimedAt != kNone && !aimedHere) return true;
  if (ray.cosine < 0) {
    if (!t_.options().backFacesVisible) pass(ray);
    return true;
  }
  applyModifiers(ray, behind);
  followSharp(ray, scatter(material, interaction(ray)));
  return true;
}

bool PathTracer::useAlternate(Ray& ray, const Alternate& alternate) {
  if (alternate.kind == Alternate::Kind::modifier) return shade(ray, alternate.modifier);
  pass(ray);
  return true;
}

bool PathTracer::shadeMaterial(Ray& ray, const Light& material, int32_t behind) {
  if (!t_.scene().importance && !countedByDirect(ray, nullptr)) emit(ray, material.radiance, nullptr, behind);
  return true;
}

bool PathTracer::shadeMaterial(Ray& ray, const Glow& material, int32_t behind) {
  if (!t_.scene().importance && !countedByDirect(ray, &material))
    emit(ray, material.radiance, &material, behind);
  return true;
}

bool PathTracer::shadeMaterial(Ray& ray, const Spotlight& material, int32_t behind) {
  if (t_.scene().importance || countedByDirect(ray, nullptr)) return true;
  if (ray.cosine < 0 || !outsideSpot(material, ray.direction)) emit(ray, material.radiance, nullptr, behind);
  return true;
}

bool PathTracer::shadeMaterial(Ray& ray, const Illum& material, int32_t behind) {
  if (!t_.scene().importance && countedByDirect(ray, nullptr)) return true;
  const LightSource* aimed = ray.aimedAt == kNone ? nullptr : &t_.lights().all()[ray.aimedAt];
  if (!aimed || aimed->surface != ray.surface) {
    if (aimed && ray.cosine > 0) {
      // Light of an illum or glow behind this illum is what this one stands for.
      const Material* other = t_.scene().materialOf(t_.scene().surfaces[aimed->surface]);
      if (!t_.scene().importance && other &&
          (std::holds_alternative<Illum>(*other) || std::holds_alternative<Glow>(*other)))
        return true;
    }
    return useAlternate(ray, material.alternate);
  }
  emit(ray, material.radiance, nullptr, behind);
  return true;
}

// Whether an indirect or specular sample met the front of a source whose light the direct calculation has
// counted.
bool PathTracer::countedByDirect(const Ray& ray, const Glow* glow) const {
  return (ray.kinds & (kAmbient | kSpecular)) && !(ray.kinds & kShadow) && ray.cosine >= 0 &&
         !beyondReach(glow, ray.length);
}

void PathTracer::emit(Ray& ray, const Rgb& radiance, const Glow* glow, int32_t behind) {
  if (ray.aimedAt != kNone && t_.lights().all()[ray.aimedAt].surface != ray.surface) return;
  if (!t_.options().sourcesVisible && !(ray.kinds & kShadow) &&
      !beyondReach(glow, ray.pathLength + ray.length))
    return;
  if (ray.cosine < 0) {
    if (!t_.options().backFacesVisible) pass(ray);
    return;
  }
  applyModifiers(ray, behind);
  ray.value = radiance * ray.pattern;
  if (!(ray.kinds & ~(kPrimary | kTransmitted)) &&
      (ray.direction - primaryDirection_).length2() < kStraight * kStraight)
    shownSource_ = t_.lightOf(ray.surface);
}

// ---- scattering

bool PathTracer::shadeBoundary(Ray& ray, const Scattering& scattering) {
  ray.extinction = scattering.extinction;
  followSharp(ray, scattering);
  return true;
}

bool PathTracer::shadeDiffusing(Ray& ray, const Scattering& scattering, const Interaction& at) {
  followSharp(ray, scattering);
  if (ray.kinds & kShadow) return true;
  sampleLobes(ray, scattering, at);
  if (maxChannel(scattering.ambientReflection) > kNegligible)
    addIndirect(ray, scattering.normal, at.normal, kReflectedAmbient, scattering.ambientReflection);
  if (maxChannel(scattering.ambientTransmission) > kNegligible)
    addIndirect(ray, -scattering.normal, -at.normal, kTransmittedAmbient, scattering.ambientTransmission);
  if (!isBlack(scattering.diffuseReflection) || !isBlack(scattering.diffuseTransmission) ||
      !isBlack(scattering.specularReflection) || !isBlack(scattering.specularTransmission))
    addDirect(ray, scattering, at);
  return true;
}

void PathTracer::followSharp(Ray& ray, const Scattering& scattering) {
  for (const SharpPath& path : scattering.sharp) {
    if ((ray.kinds & kShadow) && path.kind == kReflected) continue;
    Ray child;
    Rgb coefficient = path.coefficient;
    if (isBlack(coefficient) || !continueRay(child, path.kind, ray, coefficient)) continue;
    child.direction = path.direction;
    if (path.entersMedium) child.extinction = path.extinction;
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
  const int samples = spread > 1.5 ? std::max(1, static_cast<int>(spread * ray.weight + .5)) : 1;
  const auto sampleLobe = [&](RayKind kind, const Rgb& share, auto draw) {
    for (int i = 0; i < samples; ++i) {
      Ray child;
      const double u1 = (i + random_.uniform()) / samples, u2 = random_.uniform();
      const double weight = draw(scattering, at, spread, u1, u2, child.direction);
      if (!(weight > 0)) continue;
      Rgb coefficient = share * (weight / samples);
      if (!continueRay(child, kind, ray, coefficient)) continue;
      evaluate(child);
      ray.value += child.value * coefficient;
    }
  };
  if (scattering.sampleReflection)
    sampleLobe(kReflectedSpecular, scattering.specularReflection, sampleReflection);
  if (scattering.sampleTransmission)
    sampleLobe(kTransmittedSpecular, scattering.specularTransmission, sampleTransmission);
}

void PathTracer::addIndirect(Ray& ray, const V3d& normal, const V3d& trueNormal, RayKind kind,
                             const Rgb& coefficient) {
  const RayOptions& o = t_.options();
  if (o.ambientDivisions <= 0 || ray.ambientLevel >= o.ambientBounces || !t_.isAmbient(ray.surface)) {
    ray.value += coefficient * o.ambientValue;
    return;
  }
  int side = 1;
  if (ray.ambientLevel == 0) {
    // No more directions than can be followed: each would fall below the weight limit and most of them end.
    const double followed =
        .8 * maxChannel(coefficient) * ray.weight / (o.ambientDivisions * o.weightLimit + 1e-20);
    const double divisions = (o.ambientDivisions + o.ambientSuperSamples) * std::min(ray.weight, followed);
    side = std::max(1, static_cast<int>(std::sqrt(divisions) + .5));
  }
  V3d x, y;
  frame(normal, x, y);
  const Rgb share = coefficient / (static_cast<double>(side) * side);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      // By projected solid angle, so that every direction counts the same (Malley's method).
      const double radius = std::sqrt((i + random_.uniform()) / side);
      const double angle = 2 * kPi * (j + random_.uniform()) / side;
      const double height = std::sqrt(std::max(0., 1 - radius * radius));
      Ray child;
      child.direction = radius * std::cos(angle) * x + radius * std::sin(angle) * y + height * normal;
      if (child.direction.dot(trueNormal) <= 0) continue;
      Rgb c = share;
      if (!continueRay(child, kind, ray, c)) continue;
      ++child.ambientLevel;
      evaluate(child);
      ray.value += child.value * c;
    }
}

// ---- direct light

Ray PathTracer::traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed) {
  const LightSource& light = t_.lights().all()[sample.source];
  switch (
      t_.tracer().shadow(point, sample.direction, sample.distance, light.distant ? kNone : light.surface)) {
    case Shadow::unsure:
      return trace(point, sample.direction, 0, seed);
    case Shadow::blocked:
      break;
    case Shadow::clear: {
      Ray ray;
      ray.origin = point;
      ray.direction = sample.direction;
      ray.surface = light.surface;
      ray.length = ray.unmirroredLength = sample.distance;
      if (!light.distant) ray.point = point + sample.distance * sample.direction;
      ray.normal = sample.normal;
      ray.cosine = sample.cosine;
      primaryDirection_ = sample.direction;
      shownSource_ = kNone;
      shadeSurface(ray);
      return ray;
    }
  }
  shownSource_ = kNone;
  return Ray{};
}

// The radiance of a source along a shadow ray that is not stopped.
Rgb PathTracer::sourceValue(const Ray& ray, const SourceSample& sample) {
  const Scene& scene = t_.scene();
  const Surface& surface = scene.surfaces[t_.lights().all()[sample.source].surface];
  if (sample.cosine < 0) return Rgb(0, 0, 0);
  const Modifier& modifier = scene.modifiers[surface.material];
  const Rgb passed = passing(ray.extinction, sample.distance);
  if (surface.goal) return passed;
  if (surface.modifier == surface.material && modifier.next == kNone)
    return *sourceRadiance(std::get<Material>(modifier.content)) * passed;
  Ray child;
  child.origin = ray.point;
  child.direction = sample.direction;
  child.kind = kReflectedShadow;
  child.kinds = ray.kinds | kReflectedShadow;
  child.aimedAt = static_cast<int32_t>(sample.source);
  child.pathLength = ray.pathLength + ray.length;
  child.surface = t_.lights().all()[sample.source].surface;
  child.length = sample.distance;
  child.point = sample.distance < kFarAway ? child.origin + sample.distance * child.direction : child.origin;
  child.normal = sample.normal;
  child.cosine = sample.cosine;
  shade(child, surface.modifier);
  return child.value * passed;
}

void PathTracer::addDirect(Ray& ray, const Scattering& scattering, const Interaction& at) {
  const RayOptions& o = t_.options();
  samples_.clear();
  contributions_.clear();
  const SourceSampling how{o.sourceSubstructuring > kNegligible ? o.sourceSubstructuring / ray.weight : 0,
                           o.directJitter};
  for (uint32_t i = 0; i < t_.lights().all().size(); ++i)
    t_.lights().sample(i, ray.point, how, random_, samples_);
  for (const SourceSample& sample : samples_) {
    const Rgb coefficient =
        directCoefficient(scattering, at, sample.direction, sample.solidAngle, o.directJitter);
    if (isBlack(coefficient)) continue;
    const Rgb value = sourceValue(ray, sample) * coefficient;
    const double bright = brightness(value);
    if (bright > 0)
      contributions_.push_back(
          {sample.direction, coefficient, value, bright, sample.distance, sample.source});
  }
  if (contributions_.empty()) return;

  const size_t count = contributions_.size();
  const double threshold = o.directThreshold / ray.weight;
  // How many of those still untested are taken together to decide whether they can matter (-dc).
  size_t lookAhead = count;
  if (threshold > 0) {
    std::stable_sort(contributions_.begin(), contributions_.end(),
                     [](const auto& a, const auto& b) { return a.brightness > b.brightness; });
    remaining_.assign(count + 1, 0);
    for (size_t i = count; i-- > 0;) remaining_[i] = remaining_[i + 1] + contributions_[i].brightness;
    lookAhead = static_cast<size_t>(std::pow(static_cast<double>(count), o.directCertainty) + .5);
  }
  constexpr size_t kAlwaysTested = 2;
  size_t tested = 0, visible = 0;
  for (; tested < count; ++tested) {
    if (threshold > 0 && tested >= kAlwaysTested) {
      const double ahead = remaining_[tested] - remaining_[std::min(tested + lookAhead, count)];
      if (ahead < threshold * brightness(ray.value)) break;
    }
    const Contribution& c = contributions_[tested];
    const LightSource& light = t_.lights().all()[c.source];
    const Shadow shadow =
        t_.tracer().shadow(ray.point, c.direction, c.distance, light.distant ? kNone : light.surface);
    if (shadow == Shadow::blocked) continue;
    if (shadow == Shadow::clear) {
      ray.value += c.value;
      ++visible;
      continue;
    }
    Ray child;
    Rgb whole(1, 1, 1);
    const bool through = (ray.cosine > 0) != (ray.normal.dot(c.direction) > 0);
    if (!continueRay(child, through ? kTransmittedShadow : kReflectedShadow, ray, whole)) continue;
    child.aimedAt = static_cast<int32_t>(c.source);
    child.direction = c.direction;
    evaluate(child);
    if (maxChannel(child.value) <= kNegligible) continue;
    ray.value += child.value * c.coefficient;
    ++visible;
  }
  // Sources too weak to be tested are let through as often as those that were.
  const double share = tested ? static_cast<double>(visible) / static_cast<double>(tested) : .5;
  for (; tested < count; ++tested) ray.value += contributions_[tested].value * share;
}

// ---- output

RayAnswer answerOf(const Scene& scene, const Ray& ray) {
  RayAnswer a;
  a.origin = ray.origin;
  a.direction = ray.direction;
  a.value = ray.value;
  a.mirroredContribution = ray.mirrored;
  a.unmirroredContribution = ray.value - ray.mirrored;
  a.mirroredLength = ray.mirroredLength;
  a.unmirroredLength = ray.unmirroredLength;
  a.effectiveLength = apparentLength(ray);
  a.firstLength = ray.length;
  a.u = ray.u;
  a.v = ray.v;
  a.point = ray.point;
  if (ray.surface == kNone) return a;
  const Surface& surface = scene.surfaces[ray.surface];
  a.unperturbedNormal = ray.fromBehind ? -ray.normal : ray.normal;
  a.normal = ray.normal;
  if (ray.perturbation.length2() > 0) {
    Interaction at;
    at.direction = ray.direction;
    at.normal = ray.normal;
    at.cosine = ray.cosine;
    at.perturbation = ray.perturbation;
    double cosine = 0;
    a.normal = perturbedNormal(at, cosine);
  }
  a.surface = scene.surfaceName(surface);
  a.modifier = scene.modifierName(surface);
  a.material = scene.materialName(surface);
  return a;
}

bool needsValue(std::string_view letters) {
  return letters.find_first_of("vVrxlRXnW") != std::string_view::npos;
}

}  // namespace rsphere
