#pragma once
// How each material responds to a ray that hits it, as values: nothing is traced here. The return type of
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
// The surface emits radiance (W/sr/m2) towards the ray; patterns are included.
struct Emits {
  Radiance radiance;
};
// Sharp paths of a pane or a mirror.
struct ReflectsSharply {
  template <class M>
  ReflectsSharply(const M& material, const Interaction& at) : scattering(scatter(material, at)) {}
  Scattering scattering;
};
// Sharp reflection and refraction at a boundary between media. The boundary determines the medium that the
// ray has travelled through (Scattering::medium), which replaces the one that the ray carries.
struct Boundary {
  Scattering scattering;
};
// A prism's redirected rays, one for each of its images.
struct Redirects {
  SharpPaths paths;
};
// A shadow ray has reached the image that it was aimed at, and continues from there to the real source.
struct Relays {
  SharpPath path;
};
// The ray enters or leaves a volume of mist. extinction (per unit length): the mist's, with its pattern.
struct CrossesMist {
  const Mist& mist;
  Color extinction;
  bool enters;
};
// The ray enters or leaves antimatter. clips: the surfaces that it cuts away (Surface::clip).
struct CrossesAntimatter {
  uint64_t clips;
  Alternate cut;
  bool enters;
};
// Alternate: the surface is shaded with another modifier, or passed.

using DiffusingResponse = std::variant<Absorbs, Passes, RoundScattering>;
using EllipticResponse = std::variant<Absorbs, Passes, EllipticScattering>;
using PaneResponse = std::variant<Passes, ReflectsSharply>;
using SourceResponse = std::variant<Absorbs, Passes, Emits, Alternate>;

// Large results are constructed in place. Copying values that were just written stalls the processor, and
// took up to a tenth of the time of a ray through glass. Each may apply modifiers to the hit and turn it
// round (MaterialHit). They throw rad::Error as SurfaceFunctions does, and if the material is modified by
// another material.
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

// A goal's emission of importance. sampled: next-event estimation samples the goal.
SourceResponse goalResponse(const Radiance& importance, bool sampled, MaterialHit& hit);

}  // namespace rsphere
