// Shading of the surface that a ray hit: its chain of modifiers down to a material, and mixtures.
#include "transport/surface_shading.h"

#include "transport/ray_functions.h"
#include "transport/ray_limits.h"

namespace rsphere {

void SurfaceShading::shadeHit(Ray& ray) {
  ray.unmirroredLength = ray.length;
  const bool clipped = (t_.scene().surfaces[ray.surface].clip & ray.clips) != 0;
  if (!clipped && shadeSurface(ray)) return;
  if (std::holds_alternative<Distant>(t_.scene().surfaces[ray.surface].shape)) return;
  follower_.pass(ray);
}

// Sets the radiance that the surface emits and scatters; false if it has no material.
bool SurfaceShading::shadeSurface(Ray& ray) {
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

// Shades the ray with a chain of modifiers; false if the chain has no material.
bool SurfaceShading::shade(Ray& ray, ModifierId modifier) {
  const bool meters = t_.irradiance() == Irradiance::surface && !(ray.kinds & ~(kPrimary | kTransmitted));
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    const auto* material = std::get_if<Material>(&m.content);
    if (!material) {
      if (applyModifier(ray, modifier)) {
        // A mixture of materials must be the last modifier of a chain.
        if (m.next != kNone) throw rad::Error(t_.scene().place(m.primitive) + ": inappropriate modifier");
        return true;
      }
      continue;
    }
    if (meters && isTransparent(*material)) {
      follower_.pass(ray);
      return true;
    }
    if (meters && !isLightSource(*material) && !std::holds_alternative<Antimatter>(*material)) {
      ray.pattern = Rgb(1, 1, 1);
      return shadeMaterial(ray, kIrradianceMeter, kNone);
    }
    if (std::visit([&](const auto& kind) { return shadeMaterial(ray, kind, m.next); }, *material))
      return true;
  }
  return false;
}

// Applies a pattern, texture or mixture to the ray. Returns whether a mixture has shaded it with a material.
bool SurfaceShading::applyModifier(Ray& ray, ModifierId modifier) {
  const Content& content = t_.scene().modifiers[modifier].content;
  if (const auto* mixture = std::get_if<Mixture>(&content)) return shadeMixture(ray, modifier, *mixture);
  const FunctionPoint at = functionPoint(ray);
  if (std::holds_alternative<Pattern>(content))
    ray.pattern *= t_.functions().pattern(modifier, at, scratch_);
  else
    ray.perturbation += t_.functions().texture(modifier, at, scratch_);
  return false;
}

// Applies the modifiers of a material: patterns, textures, and mixtures of them.
void SurfaceShading::applyModifiers(Ray& ray, ModifierId modifier) {
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    if (std::holds_alternative<Material>(m.content) || applyModifier(ray, modifier))
      throw rad::Error(t_.scene().place(m.primitive) + ": conflicting material");
  }
}

bool SurfaceShading::shadeMixture(Ray& ray, ModifierId modifier, const Mixture& mixture) {
  const double share = t_.functions().mixture(modifier, functionPoint(ray), scratch_);
  if (share < 0) return false;
  struct Side {
    Ray ray;
    double share;
    bool counts, shaded = false;
  };
  Side sides[2] = {{ray, share, share > kNegligible}, {ray, 1 - share, share < 1 - kNegligible}};
  const ModifierId chains[2] = {mixture.foreground, mixture.background};
  for (int i = 0; i < 2; ++i) {
    Side& side = sides[i];
    if (!side.counts) continue;
    side.ray.weight *= side.share;
    side.ray.contribution *= side.share;
    side.shaded = shade(side.ray, chains[i]);
  }
  // If one component of a mixture is a material, void as the other component is transparent.
  for (int i = 0; i < 2; ++i)
    if (sides[i].counts && !sides[i].shaded && sides[1 - i].shaded) follower_.pass(sides[i].ray);
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

FunctionPoint SurfaceShading::functionPoint(const Ray& ray) const {
  FunctionPoint at;
  at.direction = ray.direction;
  at.normal = ray.normal;
  at.cosine = ray.cosine;
  at.point = ray.point;
  at.distance = ray.pathLength + ray.length;
  at.shadowDistance = ray.shadowLength + ray.length;
  at.u = ray.u;
  at.v = ray.v;
  at.path = ray.path;
  return at;
}

void SurfaceShading::meter(Ray& ray) { shadeMaterial(ray, kIrradianceMeter, kNone); }

Interaction SurfaceShading::interaction(const Ray& ray) const {
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
    const Surface& surface = t_.scene().surfaces[ray.surface];
    at.flat = std::holds_alternative<Polygon>(surface.shape) || std::holds_alternative<Ring>(surface.shape) ||
              std::holds_alternative<MeshFaces>(surface.shape);
    at.smoothed = surface.smoothed;
  }
  return at;
}

}  // namespace rsphere
