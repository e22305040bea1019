#include "shade/material_response.h"

#include <cmath>

namespace rsphere {
namespace {

// ---- light sources

bool beyondReach(const Glow* glow, double distance) {
  return glow && glow->reach >= -kNegligible && distance > glow->reach;
}

// Whether an indirect or specular sample hit the front of a source whose light next-event estimation already
// includes: it must not be added a second time.
bool countedByDirect(const Arrival& a, const Glow* glow = nullptr) {
  return (a.kinds & (kAmbient | kSpecular)) && !a.isShadow() && a.cosine >= 0 && !beyondReach(glow, a.length);
}

SourceResponse emission(const Color& radiance, MaterialHit& hit, const Glow* glow = nullptr) {
  const Arrival& a = hit.arrival();
  if (a.isAimed() && (!a.isAimedHere() || a.atImage)) return Absorbs{};
  if (!hit.options().sourcesVisible && !a.isShadow() && !beyondReach(glow, a.pathLength + a.length))
    return Absorbs{};
  if (hit.passesBack()) return Passes{};
  if (a.cosine < 0) return Absorbs{};
  hit.modify();
  return Emits{Radiance(radiance * hit.pattern())};
}

// ---- functions

// Applies the modifiers and turns the hit to the front.
void modifyFront(MaterialHit& hit) {
  hit.modify();
  hit.turnRound();
}

Interaction modifiedFront(MaterialHit& hit) {
  modifyFront(hit);
  return hit.interaction();
}

Interaction modified(MaterialHit& hit) {
  hit.modify();
  return hit.interaction();
}

// BRTDfunc and similar functions receive the normal and the color of the scattering.
FunctionPoint pointOf(const MaterialHit& hit, const FunctionScattering& s) {
  FunctionPoint point = hit.point();
  point.perturbedNormal = s.normal;
  point.perturbedCosine = s.cosine;
  point.color = s.color;
  return point;
}

// The functions of a component of WGMDfunc receive the normal perturbed by the component's modifiers.
FunctionPoint pointOf(const MaterialHit& hit, const Interaction& at) {
  FunctionPoint point = hit.point();
  point.perturbedCosine = at.cosine;
  point.perturbedNormal =
      at.perturbation.length2() > 0 ? perturbedNormal(at, point.perturbedCosine) : at.normal;
  return point;
}

V3d orientation(ModifierId material, MaterialHit& hit, const FunctionPoint& point) {
  return hit.functions().orientation(material, point, hit.scratch());
}

// The interaction of one component of WGMDfunc. named: empty if the component has the material's modifiers,
// whose interaction is `inherited`.
Interaction componentAt(const MaterialHit& hit, const std::optional<ModifierId>& named,
                        const Interaction& inherited) {
  return named ? hit.interactionAfter(*named) : inherited;
}

WgmdComponent componentOf(const Interaction& at, const std::array<double, 3>& values) {
  return {at, values[0], values[1], values[2]};
}

}  // namespace

// ---- surfaces that scatter diffusely or by lobes

DiffusingResponse response(const Opaque& material, MaterialHit& hit) {
  if (hit.arrival().isShadow()) return Absorbs{};
  if (hit.passesBack()) return Passes{};
  modifyFront(hit);
  return DiffusingResponse(std::in_place_type<RoundScattering>, material, hit);
}

DiffusingResponse response(const Trans& material, MaterialHit& hit) {
  if (hit.passesBack()) return Passes{};
  modifyFront(hit);
  return DiffusingResponse(std::in_place_type<RoundScattering>, material, hit);
}

EllipticResponse response(const Anisotropic& material, MaterialHit& hit) {
  if (hit.arrival().isShadow()) return Absorbs{};
  if (hit.passesBack()) return Passes{};
  modifyFront(hit);
  const V3d along = orientation(material.functions, hit, hit.point());
  return EllipticResponse(std::in_place_type<EllipticScattering>, material, along, hit);
}

std::variant<Absorbs, Passes, AshikhminLobeScattering> response(const Ashikhmin& material, MaterialHit& hit) {
  if (hit.arrival().isShadow()) return Absorbs{};
  if (hit.passesBack()) return Passes{};
  const Interaction at = modifiedFront(hit);
  return AshikhminLobeScattering(scatter(material, at, orientation(material.functions, hit, hit.point()),
                                         hit.options().specularThreshold),
                                 at);
}

std::variant<Absorbs, Passes, ProgrammedScattering> response(const FunctionScatterer& material,
                                                             MaterialHit& hit) {
  if (hit.arrival().isShadow()) return Absorbs{};
  if (hit.passesBack()) return Passes{};
  const Interaction at = modifiedFront(hit);
  const FunctionScattering s = scatter(material, at);
  return ProgrammedScattering(s, at, pointOf(hit, s), hit.functions(), hit.scratch(), material.functions);
}

ProgrammedScattering response(const BrtdFunction& material, MaterialHit& hit) {
  const Interaction at = modified(hit);
  FunctionScattering s = scatter(material, at);
  const FunctionPoint point = pointOf(hit, s);
  const SurfaceFunctions& functions = hit.functions();
  s.sharp.add(sharpTransmission(s, at, functions.transmission(material.functions, point, hit.scratch())));
  if (!hit.arrival().isShadow()) {
    s.sharp.add(sharpReflection(s, at, functions.reflection(material.functions, point, hit.scratch())));
    Color sum = s.diffuseReflection + s.diffuseTransmission;
    for (const SharpPath& path : s.sharp) sum += path.coefficient.color;
    if (maxChannel(sum) > 1 + kRoundedArgument)
      functions.warn(material.functions, "reflectance and transmittance add up to more than 1");
  }
  return {s, at, point, functions, hit.scratch(), material.functions};
}

EllipticResponse response(const WgmdFunction& material, MaterialHit& hit) {
  const bool shadow = hit.arrival().isShadow();
  if (shadow && !material.transmits) return Absorbs{};
  if (hit.passesBack()) return Passes{};
  const SurfaceFunctions& functions = hit.functions();
  const ModifierId f = material.functions;
  const Interaction own = hit.interactionAfter(hit.modifiers());

  WgmdComponent transmitted;
  if (material.transmitted.share > kNegligible) {
    const Interaction at = componentAt(hit, material.transmitted.modifier, own);
    transmitted = componentOf(at, functions.transmission(f, pointOf(hit, at), hit.scratch()));
  }
  // Shadow rays pass only if transmission is sharp.
  if (shadow && transmitted.roughnessAlong > kNegligible && transmitted.roughnessAcross > kNegligible)
    return Absorbs{};
  WgmdComponent reflected;
  if (material.reflected.share > kNegligible) {
    const Interaction at = componentAt(hit, material.reflected.modifier, own);
    reflected = componentOf(at, functions.reflection(f, pointOf(hit, at), hit.scratch()));
  }
  const V3d along = orientation(f, hit, pointOf(hit, own));
  return EllipticScattering(scatter(material, reflected, transmitted, own,
                                    componentAt(hit, material.diffuseTransmittedModifier, own), along,
                                    hit.options().specularThreshold),
                            own, hit.options());
}

std::variant<Absorbs, Passes, BsdfScattering> response(const BsdfMaterial& material, MaterialHit& hit) {
  if (hit.passesBack()) return Passes{};
  const Arrival& a = hit.arrival();
  const SurfaceFunctions& functions = hit.functions();
  const ModifierId f = material.functions;
  double thickness = material.proxy ? functions.thickness(f, hit.point(), hit.scratch()) : 0;
  if (std::abs(thickness) <= kNegligible) thickness = 0;
  // Direct views, shadow rays, and all rays from the side of the hidden geometry trace this geometry itself
  // instead of its proxy.
  if (thickness != 0 &&
      (a.isShadow() || !(a.kinds & (kSpecular | kAmbient)) || (thickness > 0) != hit.interaction().front))
    return Passes{};
  if (a.isShadow() && !material.aperture) return Absorbs{};
  const V3d up = functions.up(f, hit.point(), hit.scratch());
  const Interaction at = modified(hit);
  const BsdfData& data = functions.bsdf(f);
  const std::optional<BsdfFrame> frame = bsdfFrame(at, up);
  if (!frame) {
    functions.warn(f, "illegal orientation vector");
    return Absorbs{};
  }
  return BsdfScattering(material, data, at, *frame, thickness,
                        hit.samplesOf(4 * hit.options().specularSampling), hit.options());
}

// ---- sharp reflection and transmission

Boundary response(const Dielectric& material, MaterialHit& hit) {
  const Interaction at = modified(hit);
  const MaterialOptions& o = hit.options();
  return {scatter(material, at, at.front ? hit.medium() : o.medium, o.basicRadiance)};
}

Boundary response(const Interface& material, MaterialHit& hit) {
  return {scatter(material, modified(hit), hit.options().basicRadiance)};
}

PaneResponse response(const Glass& material, MaterialHit& hit) {
  if (hit.arrival().cosine <= 0 && !hit.options().backFacesVisible) return Passes{};
  return PaneResponse(std::in_place_type<ReflectsSharply>, material, modifiedFront(hit));
}

std::variant<Absorbs, Passes, Alternate, ReflectsSharply, Relays> response(const Mirror& material,
                                                                           MaterialHit& hit) {
  const Arrival& a = hit.arrival();
  if (material.alternate.kind != Alternate::Kind::none && !a.isAimedHere()) {
    // An indirect ray that hits the front is reflected by the mirror and not shaded with the alternate
    // material, because light along this path is mirrored too. Transparent alternates are an exception.
    const bool free = a.cosine < 0 || !(a.kinds & (kAmbient | kSpecular));
    const auto transparent = [&] {
      const Scene& scene = hit.scene();
      const Material* other = scene.materialAt(scene.firstMaterial(material.alternate.modifier));
      return other && isTransparent(*other);
    };
    if (free || transparent()) return material.alternate;
  }
  if (a.isAimed() && !a.isAimedHere()) return Absorbs{};
  if (hit.passesBack()) return Passes{};
  if (a.cosine < 0) return Absorbs{};
  const Interaction at = modified(hit);
  if (!a.isAimed()) return ReflectsSharply(material, at);
  // Textures are ignored: the virtual source is the image in the unperturbed plane.
  return Relays{
      {at.direction + 2 * at.cosine * at.normal, Coefficient(material.reflectance * at.pattern), kReflected}};
}

std::variant<Absorbs, Redirects, Relays> response(const Prism& material, MaterialHit& hit) {
  const Arrival& a = hit.arrival();
  if (a.isAimed() && !(a.isAimedHere() && a.atImage)) return Absorbs{};
  FunctionPoint point = hit.point();
  if (a.isAimed()) point.toTarget = hit.towardsSource();
  const auto path = [&](int image) {
    const auto [share, direction] =
        hit.functions().redirection(material.functions, image, point, hit.scratch());
    return SharpPath{direction, Coefficient(share), kTransmitted};
  };
  if (a.isAimed()) {
    if (a.image >= material.images) return Absorbs{};
    return Relays{path(a.image)};
  }
  Redirects redirects;
  const bool flat = hit.interaction().flat;
  for (int image = 0; image < material.images; ++image) {
    SharpPath redirected = path(image);
    redirected.lengthCounts = flat;
    redirects.paths.add(redirected);
  }
  return redirects;
}

// ---- volumes

CrossesMist response(const Mist& material, MaterialHit& hit) {
  Color extinction = material.extinction;
  if (!isBlack(extinction)) {
    hit.modify();
    extinction *= hit.pattern();
  }
  return {material, extinction, hit.arrival().cosine > 0};
}

CrossesAntimatter response(const Antimatter& material, MaterialHit& hit) {
  return {material.clips, material.cut, hit.arrival().cosine > 0};
}

// ---- light sources

SourceResponse response(const Light& material, MaterialHit& hit) {
  if (hit.scene().importance || countedByDirect(hit.arrival())) return Absorbs{};
  return emission(material.radiance, hit);
}

SourceResponse response(const Glow& material, MaterialHit& hit) {
  if (hit.scene().importance || countedByDirect(hit.arrival(), &material)) return Absorbs{};
  return emission(material.radiance, hit, &material);
}

SourceResponse response(const Spotlight& material, MaterialHit& hit) {
  const Arrival& a = hit.arrival();
  if (hit.scene().importance || countedByDirect(a)) return Absorbs{};
  if (a.cosine >= 0 && outsideSpot(material, hit.interaction().direction)) return Absorbs{};
  return emission(material.radiance, hit);
}

SourceResponse response(const Illum& material, MaterialHit& hit) {
  const Scene& scene = hit.scene();
  const Arrival& a = hit.arrival();
  if (!scene.importance && countedByDirect(a)) return Absorbs{};
  if (a.isAimedHere() && !a.atImage) return emission(material.radiance, hit);
  if (a.isAimed() && !a.atImage && a.cosine > 0) {
    // The radiance of this illum already includes the light of any illum or glow behind it.
    const Material* other = scene.materialOf(scene.surfaces[a.target]);
    if (!scene.importance && other &&
        (std::holds_alternative<Illum>(*other) || std::holds_alternative<Glow>(*other)))
      return Absorbs{};
  }
  return material.alternate;
}

SourceResponse goalResponse(const Radiance& importance, bool sampled, MaterialHit& hit) {
  if (sampled && countedByDirect(hit.arrival())) return Absorbs{};
  return emission(importance.color, hit);
}

}  // namespace rsphere
