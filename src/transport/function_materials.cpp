// Shading of materials that depend on function files: anisotropic lobes, programmed and tabulated scattering.
#include "shade/function_reflection.h"
#include "transport/ray_functions.h"
#include "transport/ray_limits.h"
#include "transport/surface_shading.h"

namespace rsphere {
namespace {

// Maximal number of draws for a sample of ashik2 that lies above the surface; as in RADIANCE.
constexpr int kMostTries = 10;
// -ss below 1 does not narrow the lobe of ashik2. The original draws one sample per ray and distributes those
// of successive rays evenly. Here samples depend on their ray alone, and four of them give as little noise.
constexpr int kAshikhminSamples = 4;

// Warns once per material if a highlight is anisotropic but its orientation vector gives no direction
// within the surface.
void warnOfOrientation(const SurfaceFunctions& functions, ModifierId material,
                       const AnisotropicScattering& s) {
  if (s.reflected.disoriented || s.transmitted.disoriented)
    functions.warn(material, "illegal orientation vector");
}

}  // namespace

// Lets the ray pass if it hit a back face and these are invisible (-bv). Returns whether it did.
bool SurfaceShading::passesBack(Ray& ray) {
  if (ray.cosine >= 0 || t_.options().backFacesVisible) return false;
  follower_.pass(ray);
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Anisotropic& material, ModifierId behind) {
  if ((ray.kinds & kShadow) || passesBack(ray)) return true;
  applyModifiers(ray, behind);
  turnRound(ray);
  const Interaction at = interaction(ray);
  const V3d along = t_.functions().orientation(material.functions, functionPoint(ray), scratch_);
  const AnisotropicScattering s = scatter(material, at, along, t_.options().specularThreshold);
  warnOfOrientation(t_.functions(), material.functions, s);
  return shadeElliptic(ray, s, at);
}

bool SurfaceShading::shadeElliptic(Ray& ray, const AnisotropicScattering& s, const Interaction& at) {
  specular_.follow(ray, s.sharp);
  if (ray.kinds & kShadow) return true;
  const double spread = t_.options().specularSampling;
  if (s.reflected.sampled)
    specular_.sampleLobe(ray, kReflectedSpecular, s.reflected.share, [&](double u1, double u2, V3d& d) {
      return sampleReflection(s.reflected, at, spread, u1, u2, d);
    });
  if (s.transmitted.sampled)
    specular_.sampleLobe(ray, kTransmittedSpecular, s.transmitted.share, [&](double u1, double u2, V3d& d) {
      return sampleTransmission(s.transmitted, at, spread, u1, u2, d);
    });
  indirect_.add(ray, s.reflection.normal, at, kReflectedAmbient, s.reflection.ambient);
  indirect_.add(ray, s.transmission.normal, at, kTransmittedAmbient, s.transmission.ambient);
  direct_.add(ray, [&, jitter = t_.options().directJitter](const V3d& toSource, double solidAngle) {
    return directCoefficient(s, at.direction, toSource, solidAngle, jitter);
  });
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Ashikhmin& material, ModifierId behind) {
  if ((ray.kinds & kShadow) || passesBack(ray)) return true;
  applyModifiers(ray, behind);
  turnRound(ray);
  const Interaction at = interaction(ray);
  const V3d along = t_.functions().orientation(material.functions, functionPoint(ray), scratch_);
  const AshikhminScattering s = scatter(material, at, along, t_.options().specularThreshold);
  if (s.sampled)
    specular_.sampleLobe(
        ray, kReflectedSpecular, s.share,
        [&](double u1, double u2, V3d& d) {
          for (int tries = 0; tries < kMostTries; ++tries) {
            if (sampleReflection(s, at, u1, u2, d)) return 1;
            u1 = state_.random.uniform();
            u2 = state_.random.uniform();
          }
          return 0;
        },
        kAshikhminSamples);
  indirect_.add(ray, s.reflection.normal, at, kReflectedAmbient, s.reflection.ambient);
  direct_.add(ray, [&](const V3d& toSource, double solidAngle) {
    return directCoefficient(s, at.direction, toSource, solidAngle);
  });
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const FunctionScatterer& material, ModifierId behind) {
  if ((ray.kinds & kShadow) || passesBack(ray)) return true;
  applyModifiers(ray, behind);
  turnRound(ray);
  const Interaction at = interaction(ray);
  return shadeByFunction(ray, scatter(material, at), at, material.functions);
}

bool SurfaceShading::shadeMaterial(Ray& ray, const BrtdFunction& material, ModifierId behind) {
  applyModifiers(ray, behind);
  const Interaction at = interaction(ray);
  FunctionScattering s = scatter(material, at);
  const FunctionPoint point = functionPoint(ray, s);
  const SurfaceFunctions& functions = t_.functions();
  s.sharp.add(sharpTransmission(s, at, functions.transmission(material.functions, point, scratch_)));
  if (!(ray.kinds & kShadow))
    s.sharp.add(sharpReflection(s, at, functions.reflection(material.functions, point, scratch_)));
  return shadeByFunction(ray, s, at, material.functions);
}

FunctionPoint SurfaceShading::functionPoint(const Ray& ray, const FunctionScattering& s) const {
  FunctionPoint point = functionPoint(ray);
  point.perturbedNormal = s.normal;
  point.perturbedCosine = s.cosine;
  point.color = s.color;
  return point;
}

bool SurfaceShading::shadeByFunction(Ray& ray, const FunctionScattering& s, const Interaction& at,
                                     ModifierId functions) {
  specular_.follow(ray, s.sharp);
  if (ray.kinds & kShadow) return true;
  indirect_.add(ray, s.normal, at, kReflectedAmbient, s.ambientReflection);
  indirect_.add(ray, s.normal, at, kTransmittedAmbient, s.ambientTransmission);
  if (isBlack(s.diffuseReflection) && isBlack(s.diffuseTransmission) && isBlack(s.directionalReflection) &&
      isBlack(s.directionalTransmission))
    return true;
  const FunctionPoint point = functionPoint(ray, s);
  direct_.add(ray, [&](const V3d& toSource, double solidAngle) {
    return directCoefficient(s, toSource, solidAngle, [&] {
      return t_.functions().distribution(functions, point, toSource, solidAngle, scratch_);
    });
  });
  return true;
}

// ---- WGMDfunc

// The interaction of one component of the material, after the modifiers that it names. named: empty if it has
// the modifiers of the material, whose interaction is `inherited`.
Interaction SurfaceShading::component(const Ray& ray, const std::optional<ModifierId>& named,
                                      const Interaction& inherited) {
  if (!named) return inherited;
  Ray own = ray;
  applyModifiers(own, *named);
  return interaction(own);
}

// The functions of a component get the normal as perturbed by the component's modifiers.
FunctionPoint SurfaceShading::functionPoint(const Ray& ray, const Interaction& at) const {
  FunctionPoint point = functionPoint(ray);
  point.perturbedCosine = at.cosine;
  point.perturbedNormal =
      at.perturbation.length2() > 0 ? perturbedNormal(at, point.perturbedCosine) : at.normal;
  return point;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const WgmdFunction& material, ModifierId behind) {
  if ((ray.kinds & kShadow) && !material.transmits) return true;
  if (passesBack(ray)) return true;
  const SurfaceFunctions& functions = t_.functions();
  const ModifierId f = material.functions;
  const Interaction own = component(ray, behind, {});

  WgmdComponent transmitted;
  if (material.transmitted.share > kNegligible) {
    transmitted.at = component(ray, material.transmitted.modifier, own);
    const auto v = functions.transmission(f, functionPoint(ray, transmitted.at), scratch_);
    transmitted.share = v[0];
    transmitted.roughnessAlong = v[1];
    transmitted.roughnessAcross = v[2];
  }
  // Shadow rays pass only if the transmission is sharp.
  if ((ray.kinds & kShadow) && transmitted.roughnessAlong > kNegligible &&
      transmitted.roughnessAcross > kNegligible)
    return true;
  WgmdComponent reflected;
  if (material.reflected.share > kNegligible) {
    reflected.at = component(ray, material.reflected.modifier, own);
    const auto v = functions.reflection(f, functionPoint(ray, reflected.at), scratch_);
    reflected.share = v[0];
    reflected.roughnessAlong = v[1];
    reflected.roughnessAcross = v[2];
  }
  const V3d along = functions.orientation(f, functionPoint(ray, own), scratch_);
  return shadeElliptic(
      ray,
      scatter(material, reflected, transmitted, own, component(ray, material.diffuseTransmittedModifier, own),
              along, t_.options().specularThreshold),
      own);
}

}  // namespace rsphere
