// Shading of each material: emission, reflection and transmission at the hit of a ray.
#include "transport/ray_functions.h"
#include "transport/ray_limits.h"
#include "transport/surface_shading.h"

namespace rsphere {
namespace {

// A ray is straight if its direction (unit) changed by less than this on its way through panes.
constexpr double kStraight = 1e-9;

bool beyondReach(const Glow* glow, double distance) {
  return glow && glow->reach >= -kNegligible && distance > glow->reach;
}

// Whether the scattered light has no strong peak: the peak of a lobe, share / (4 pi alpha^2) at normal
// incidence, is at most kMost times the diffuse part, share / pi.
bool isEven(const Scattering& s) {
  constexpr double kMost = 4;
  return maxChannel(s.specularReflection + s.specularTransmission) <=
         kMost * 4 * s.alpha2 * maxChannel(s.diffuseReflection + s.diffuseTransmission);
}

}  // namespace

// Surfaces that scatter diffusely or by a rough lobe.
bool SurfaceShading::shadeDiffusing(Ray& ray, const Scattering& scattering, const Interaction& at) {
  specular_.follow(ray, scattering.sharp);
  if (ray.kinds & kShadow) return true;
  specular_.sampleLobes(ray, scattering, at);
  if (maxChannel(scattering.ambientReflection) > kNegligible)
    indirect_.add(ray, scattering.normal, at.normal, kReflectedAmbient, scattering.ambientReflection);
  if (maxChannel(scattering.ambientTransmission) > kNegligible)
    indirect_.add(ray, -scattering.normal, -at.normal, kTransmittedAmbient, scattering.ambientTransmission);
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
      direct_.addOfChosen(ray, coefficientOf, front);
    else
      direct_.add(ray, coefficientOf, front);
  }
  return true;
}

bool SurfaceShading::shadeBoundary(Ray& ray, const Scattering& scattering) {
  ray.medium = scattering.medium;
  specular_.follow(ray, scattering.sharp);
  return true;
}

template <class M>
bool SurfaceShading::shadeTwoSided(Ray& ray, const M& material, ModifierId behind) {
  if (ray.cosine < 0 && !t_.options().backFacesVisible) {
    follower_.pass(ray);
    return true;
  }
  applyModifiers(ray, behind);
  turnRound(ray);
  const Interaction at = interaction(ray);
  return shadeDiffusing(ray, scatter(material, at, t_.options().specularThreshold), at);
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Opaque& material, ModifierId behind) {
  return (ray.kinds & kShadow) || shadeTwoSided(ray, material, behind);
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Trans& material, ModifierId behind) {
  return shadeTwoSided(ray, material, behind);
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Dielectric& material, ModifierId behind) {
  applyModifiers(ray, behind);
  const Interaction at = interaction(ray);
  return shadeBoundary(ray, scatter(material, at, at.front ? ray.medium : t_.medium(), t_.basicRadiance()));
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Interface& material, ModifierId behind) {
  applyModifiers(ray, behind);
  return shadeBoundary(ray, scatter(material, interaction(ray), t_.basicRadiance()));
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Glass& material, ModifierId behind) {
  if (ray.cosine <= 0 && !t_.options().backFacesVisible) {
    follower_.pass(ray);
    return true;
  }
  applyModifiers(ray, behind);
  turnRound(ray);
  specular_.follow(ray, scatter(material, interaction(ray)).sharp);
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Mirror& material, ModifierId behind) {
  const LightSource* target = targetOf(ray);
  const bool aimedHere = target && target->surface == ray.surface;
  if (material.alternate.kind != Alternate::Kind::none && !aimedHere) {
    // An indirect ray that hits the front is reflected by the mirror and not shaded with the alternate
    // material, because the light along this path is mirrored too. Transparent alternates are an exception.
    const bool free = ray.cosine < 0 || !(ray.kinds & (kAmbient | kSpecular));
    const auto transparent = [&] {
      const ModifierId m = material.alternate.modifier;
      const Material* other = t_.scene().materialAt(t_.scene().firstMaterial(m));
      return other && isTransparent(*other);
    };
    if (free || transparent()) return useAlternate(ray, material.alternate);
  }
  if (target && !aimedHere) return true;
  if (ray.cosine < 0) {
    if (!t_.options().backFacesVisible) follower_.pass(ray);
    return true;
  }
  applyModifiers(ray, behind);
  if (target) {
    // Textures are ignored: the virtual source is the image in the unperturbed plane.
    relay(ray, kReflected, ray.direction + 2 * ray.cosine * ray.normal, material.reflectance * ray.pattern);
    return true;
  }
  specular_.follow(ray, scatter(material, interaction(ray)).sharp);
  return true;
}

// The light source that a shadow ray is aimed at; null for other rays.
const LightSource* SurfaceShading::targetOf(const Ray& ray) const {
  return ray.aimedAt == kNone ? nullptr : &t_.lights().all()[ray.aimedAt];
}

// Continues a shadow ray that has reached the virtual source that it was aimed at. It goes on towards the
// source that is relayed there.
void SurfaceShading::relay(Ray& ray, RayKind kind, const V3d& direction, Rgb coefficient) {
  Ray child;
  if (!continueRay(t_, state_.random, child, kind, ray, coefficient)) return;
  child.aimedAt = t_.lights().all()[ray.aimedAt].relayed;
  child.unobstructed = ray.unobstructed;
  child.direction = direction.normalized();
  follower_.follow(child);
  ray.value += child.value * coefficient;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Prism& material, ModifierId) {
  const LightSource* target = targetOf(ray);
  if (target && target->surface != ray.surface) return true;
  FunctionPoint at = functionPoint(ray);
  if (target) {
    const LightSource& source = t_.lights().all()[target->relayed];
    at.toTarget = (source.distant ? source.center : source.center - ray.point).normalized();
  }
  for (int image = 0; image < material.images; ++image) {
    if (target && target->image != image) continue;
    const auto [share, direction] = t_.functions().redirection(material.functions, image, at, scratch_);
    Rgb coefficient(share, share, share);
    if (target) {
      relay(ray, kTransmitted, direction, coefficient);
      continue;
    }
    Ray child;
    if (share == 0 || !continueRay(t_, state_.random, child, kTransmitted, ray, coefficient)) continue;
    child.direction = direction;
    follower_.follow(child);
    ray.value += child.value * coefficient;
    if (interaction(ray).flat) ray.unmirroredLength = ray.length + apparentLength(child);
  }
  return true;
}

bool SurfaceShading::useAlternate(Ray& ray, const Alternate& alternate) {
  if (alternate.kind == Alternate::Kind::modifier) return shade(ray, alternate.modifier);
  follower_.pass(ray);
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Light& material, ModifierId behind) {
  if (!t_.scene().importance && !countedByDirect(ray, nullptr)) emit(ray, material.radiance, nullptr, behind);
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Glow& material, ModifierId behind) {
  if (!t_.scene().importance && !countedByDirect(ray, &material))
    emit(ray, material.radiance, &material, behind);
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Spotlight& material, ModifierId behind) {
  if (t_.scene().importance || countedByDirect(ray, nullptr)) return true;
  if (ray.cosine < 0 || !outsideSpot(material, ray.direction)) emit(ray, material.radiance, nullptr, behind);
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Illum& material, ModifierId behind) {
  if (!t_.scene().importance && countedByDirect(ray, nullptr)) return true;
  const LightSource* aimed = targetOf(ray);
  if (!aimed || aimed->surface != ray.surface || aimed->isVirtual()) {
    if (aimed && !aimed->isVirtual() && ray.cosine > 0) {
      // This illum already represents the light of any illum or glow behind it.
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

// Whether an indirect or specular sample hit the front of a source whose light next-event estimation already
// includes, so that it must not be added again.
bool SurfaceShading::countedByDirect(const Ray& ray, const Glow* glow) const {
  return (ray.kinds & (kAmbient | kSpecular)) && !(ray.kinds & kShadow) && ray.cosine >= 0 &&
         !beyondReach(glow, ray.length);
}

void SurfaceShading::emit(Ray& ray, const Rgb& radiance, const Glow* glow, ModifierId behind) {
  if (const LightSource* target = targetOf(ray);
      target && (target->surface != ray.surface || target->isVirtual()))
    return;
  if (!t_.options().sourcesVisible && !(ray.kinds & kShadow) &&
      !beyondReach(glow, ray.pathLength + ray.length))
    return;
  if (ray.cosine < 0) {
    if (!t_.options().backFacesVisible) follower_.pass(ray);
    return;
  }
  applyModifiers(ray, behind);
  ray.value = radiance * ray.pattern;
  // The ray shows this source only if it came straight or was mirrored once.
  const unsigned others = ray.kinds & ~(kPrimary | kTransmitted);
  if (t_.lightOf(ray.surface) == kNone || others != (ray.mirror == kNone ? 0u : kReflected)) return;
  if (state_.shown.source != kNone && (state_.shown.mirror == kNone || ray.mirror != kNone)) return;
  if (isStraight(ray)) state_.shown = {ray.surface, ray.mirror};
}

// Whether a ray continues the primary ray in a straight line, except for its reflection by ray.mirror, and
// passes no surface that blocks shadow rays, so that shadow rays to the source reach it as well.
bool SurfaceShading::isStraight(const Ray& ray) const {
  for (const Ray* before = ray.parent; before; before = before->parent)
    if (before->surface != kNone && before->surface != ray.mirror &&
        t_.tracer().stopsShadows(before->surface, before->cosine > 0))
      return false;
  V3d direction = state_.primaryDirection;
  if (ray.mirror != kNone) {
    const V3d& normal = *planeNormal(t_.scene().surfaces[ray.mirror].shape);
    direction -= 2 * normal.dot(direction) * normal;
  }
  return (ray.direction - direction).length2() < kStraight * kStraight;
}

}  // namespace rsphere
