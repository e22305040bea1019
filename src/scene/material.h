#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/color.h"
#include "base/constants.h"
#include "scene/ids.h"

namespace rsphere {

// Materials as scene files define them (RADIANCE reference manual, "Material types"): validated values only.
// How they scatter light is in shade/. Colors are per channel; angles are in degrees as in the files.

// plastic: uncolored highlights. metal: highlights have the material's color.
struct Opaque {
  Color color;
  double specularity = 0;  // fraction reflected specularly
  double roughness = 0;    // rms slope of the facets; 0: perfect mirror reflection
  bool metal = false;
};
struct Trans {
  Color color;
  double specularity = 0, roughness = 0;
  double transmissivity = 0;       // transmitted fraction of the light that is not reflected specularly
  double transmittedSpecular = 0;  // fraction of the transmitted light that is not scattered
};
// The surface of a solid, with Fresnel reflection and absorption per unit length.
struct Dielectric {
  Color transmission;  // per unit length
  double refraction = 1;
  double hartmann = 0;  // dispersion constant, nm
};
struct Interface {
  Color innerTransmission;
  double innerRefraction = 1;
  Color outerTransmission;
  double outerRefraction = 1;
};
// A thin pane. transmissivity: of a single passage at normal incidence, without interreflection.
struct Glass {
  Color transmissivity;
  double refraction = 1.52;
};

// `functions` in the materials below: the index of the material's modifier, with which SurfaceFunctions
// evaluates its functions.

// plastic2, metal2 and trans2: elliptical highlights. The functions give a direction, which is projected onto
// the surface; the roughnesses along it and across it are both above 0.
struct Anisotropic {
  Color color;
  double specularity = 0;
  double roughnessAlong = 0, roughnessAcross = 0;
  bool metal = false;
  bool trans = false;  // trans2: transmits light as Trans does
  double transmissivity = 0, transmittedSpecular = 0;
  ModifierId functions = kNone;
};
// ashik2: higher powers mean a smoother surface. The reflection is the sum of both colors.
struct Ashikhmin {
  Color diffuse, specular;
  double powerAlong = 0, powerAcross = 0;
  ModifierId functions = kNone;
};
// plasfunc, metfunc, transfunc, plasdata, metdata and transdata: the specular component is scattered
// according to a function of the direction to a light source.
struct FunctionScatterer {
  Color color;
  double specularity = 0;
  bool metal = false;
  double transmissivity = 0, transmittedSpecular = 0;
  ModifierId functions = kNone;
};
// BRTDfunc. Contains only arguments that are plain numbers; the others are evaluated at each hit.
struct BrtdFunction {
  Color diffuseFront, diffuseBack, diffuseTransmitted;
  bool transmits = true;     // sharply: some transmission argument is not "0"
  bool directional = true;   // some distribution function is not "0"
  double mostReflected = 1;  // upper bound of the sharp reflection of either side; 1 if functions decide
  double mostTransmitted = 1;
  ModifierId functions = kNone;
};
// WGMDfunc: like trans2, but each component has its own modifier and functions.
struct WgmdFunction {
  // Upper bound of the lobe's share and lower bounds of its roughnesses. If functions decide: 1 and 0.
  struct Lobe {
    double share = 1, roughnessAlong = 0, roughnessAcross = 0;
    std::optional<ModifierId> modifier;  // kNone: void; empty: the material's
  };
  Color diffuseFront, diffuseBack, diffuseTransmitted;
  Lobe reflected, transmitted;
  std::optional<ModifierId> diffuseTransmittedModifier;
  bool transmits = true;  // the specular transmission is not "0"
  ModifierId functions = kNone;
};

// BSDF and aBSDF: scattering from an XML file, to which diffuse colors are added.
struct BsdfMaterial {
  bool aperture = false;  // aBSDF: light that passes straight through is treated separately
  bool proxy = false;     // BSDF whose thickness is not "0": a proxy for geometry that it hides
  Color diffuseFront{0, 0, 0}, diffuseBack{0, 0, 0}, diffuseTransmitted{0, 0, 0};
  ModifierId functions = kNone;
};

// The shading of an illum or mirror for rays that neither sample it as a light source nor are mirrored as
// part of a virtual source.
struct Alternate {
  enum class Kind : uint8_t { none, pass, modifier } kind = Kind::none;
  ModifierId modifier = kNone;  // for Kind::modifier
};
struct Mirror {
  Color reflectance;
  Alternate alternate;
};

// prism1 and prism2: a plane surface that redirects light in one or two directions, given by functions.
struct Prism {
  int images = 1;
  ModifierId functions = kNone;
};
// Surfaces with certain modifiers do not exist between the front and the back of antimatter. cut: shading of
// the places where its back cuts through a volume enclosed by these surfaces; with Kind::pass, the cut is
// open.
struct Antimatter {
  uint64_t clips = 0;  // bits of those modifiers, see Surface::clip
  Alternate cut{Alternate::Kind::pass};
};
// A volume that absorbs and scatters light. sources: the light sources whose light is scattered;
// "mirror>lamp" is the image of the lamp by a mirror or prism.
struct Mist {
  Color extinction{0, 0, 0};                        // per unit length, added to the surrounding medium's
  bool hasAlbedo = false, hasEccentricity = false;  // if not, the surrounding medium's values apply
  Color albedo{0, 0, 0};                            // fraction of the extinction that is scattered
  double eccentricity = 0;                          // of the Henyey-Greenstein phase function
  std::vector<std::string> sources;
  uint32_t number = 0;  // index among the scene's mists
};

struct Light {
  Color radiance;  // W/sr/m2
};
struct Illum {
  Color radiance;
  Alternate alternate;  // Kind::none, too, lets rays pass
};
// reach (world units): nearer surfaces are lit by shadow rays, others only by indirect rays that hit it by
// chance. 0: by such rays alone. Negative: it lights nothing and is only seen directly.
struct Glow {
  Color radiance;
  double reach = 0;
};
struct Spotlight {
  Color radiance;
  double solidAngle = 0;   // of the cone, sr
  V3d aim{0, 0, 1};        // unit
  double focalLength = 0;  // length of the aim vector as given: the focus lies this far behind the surface
};

// Whether a point is outside a spotlight's cone. towards: from the point to the light (unit).
inline bool outsideSpot(const Spotlight& spot, const V3d& towards) {
  return spot.solidAngle < 2 * kPi * (1 + spot.aim.dot(towards));
}

using Material = std::variant<Opaque, Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction,
                              WgmdFunction, BsdfMaterial, Dielectric, Interface, Glass, Mirror, Prism,
                              Antimatter, Mist, Light, Illum, Glow, Spotlight>;
// Code that handles only one type of material asserts this number: it stops compiling when a type is added,
// until somebody has checked it.
inline constexpr size_t kMaterialTypes = std::variant_size_v<Material>;

}  // namespace rsphere
