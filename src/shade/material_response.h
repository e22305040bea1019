#pragma once
// The response of each material to a ray that hits it, as a value: nothing is traced here. The return type of
// each overload of response() lists the possible outcomes for a material, and the tracer handles each of
// them. A new material does not compile until it has an overload.
#include <variant>

#include "shade/bsdf_scattering.h"
#include "shade/material_hit.h"
#include "shade/surface_scattering.h"

namespace rsphere {

// The ray ends here and gets no light.
struct Absorbs {};
// The ray continues straight on, as if nothing were there.
struct Passes {};
// The surface emits radiance (W/sr/m2) towards the ray's origin, with patterns applied.
struct Emits {
  Radiance radiance;
};
// Sharp paths of a pane or a mirror.
struct ReflectsSharply {
  template <class M>
  ReflectsSharply(const M& material, const Interaction& at) : scattering(scatter(material, at)) {}
  Scattering scattering;
};
// Sharp reflection and refraction at a boundary between media. The boundary determines the medium through
// which the ray arrived (Scattering::medium), which replaces the medium recorded in the ray.
struct Boundary {
  Scattering scattering;
};
// A prism's redirected rays, one for each of its images.
struct Redirects {
  SharpPaths paths;
};
// A shadow ray has reached the image at which it was aimed, and continues from there to the real source.
struct Relays {
  SharpPath path;
};
// The ray enters or leaves a volume of mist. extinction (per unit length): the mist's, with its pattern.
struct CrossesMist {
  const Mist& mist;
  Color extinction;
  bool enters;
};
// The ray enters or leaves antimatter. clips: bits of the surfaces that it removes (Surface::clip).
struct CrossesAntimatter {
  uint64_t clips;
  Alternate cut;
  bool enters;
};
// The outcome Alternate: the surface is shaded with another modifier, or the ray passes.

using DiffusingResponse = std::variant<Absorbs, Passes, RoundScattering>;
using EllipticResponse = std::variant<Absorbs, Passes, EllipticScattering>;
using PaneResponse = std::variant<Passes, ReflectsSharply>;
using SourceResponse = std::variant<Absorbs, Passes, Emits, Alternate>;

// All response() functions may apply modifiers to the hit and turn it round (MaterialHit). They throw
// rad::Error like SurfaceFunctions, and if a material modifies the material. Large results are constructed in
// place, because copying values that were just written stalls the processor: it took up to a tenth of the
// time of a ray through glass.
DiffusingResponse response(const Opaque& material, MaterialHit& hit);
DiffusingResponse response(const Trans& material, MaterialHit& hit);
EllipticResponse response(const Anisotropic& material, MaterialHit& hit);
std::variant<Absorbs, Passes, AshikhminLobeScattering> response(const Ashikhmin& material, MaterialHit& hit);
std::variant<Absorbs, Passes, ProgrammedScattering> response(const FunctionScatterer& material,
                                                             MaterialHit& hit);
ProgrammedScattering response(const BrtdFunction& material, MaterialHit& hit);
EllipticResponse response(const WgmdFunction& material, MaterialHit& hit);
std::variant<Absorbs, Passes, BsdfScattering> response(const BsdfMaterial& material, MaterialHit& hit);
Boundary response(const Dielectric& material, MaterialHit& hit);
Boundary response(const Interface& material, MaterialHit& hit);
PaneResponse response(const Glass& material, MaterialHit& hit);
std::variant<Absorbs, Passes, Alternate, ReflectsSharply, Relays> response(const Mirror& material,
                                                                           MaterialHit& hit);
std::variant<Absorbs, Redirects, Relays> response(const Prism& material, MaterialHit& hit);
CrossesMist response(const Mist& material, MaterialHit& hit);
CrossesAntimatter response(const Antimatter& material, MaterialHit& hit);
SourceResponse response(const Light& material, MaterialHit& hit);
SourceResponse response(const Illum& material, MaterialHit& hit);
SourceResponse response(const Glow& material, MaterialHit& hit);
SourceResponse response(const Spotlight& material, MaterialHit& hit);

// The emission of importance by a goal. sampled: whether next-event estimation samples the goal.
SourceResponse goalResponse(const Radiance& importance, bool sampled, MaterialHit& hit);

}  // namespace rsphere
