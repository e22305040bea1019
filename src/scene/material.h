#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/rgb.h"

namespace rsphere {

// Materials as scene files give them (RADIANCE reference manual, "Material types"): values only, checked.
// What they do to light is in shade/. Colours are per channel; angles are in degrees as in the files.

// plastic: uncoloured highlights. metal: highlights take the material's colour. trans: plastic that also
// transmits.
struct Opaque {
  Rgb color;
  double specularity = 0;  // share reflected specularly
  double roughness = 0;    // rms slope of facets; 0: a perfect mirror's lobe
  bool metal = false;
};
struct Trans {
  Rgb color;
  double specularity = 0, roughness = 0;
  double transmissivity = 0;       // share of what is not specularly reflected that passes
  double transmittedSpecular = 0;  // share of that which is not scattered
};
// Solid, with Fresnel reflection and absorption per unit length.
struct Dielectric {
  Rgb transmission;  // per unit length
  double refraction = 1;
  double hartmann = 0;  // dispersion constant, nm
};
struct Interface {
  Rgb innerTransmission;
  double innerRefraction = 1;
  Rgb outerTransmission;
  double outerRefraction = 1;
};
// A thin pane: transmissivity is that of one passage at right angles, without reflections.
struct Glass {
  Rgb transmissivity;
  double refraction = 1.52;
};

// Materials with function files know them by their own index in Scene::modifiers (SurfaceFunctions).

// plastic2, metal2 and trans2: highlights of elliptic shape. Roughness is that along the direction that the
// functions give, projected onto the surface, and across it; both above 0.
struct Anisotropic {
  Rgb color;
  double specularity = 0;
  double roughnessAlong = 0, roughnessAcross = 0;
  bool metal = false;
  bool trans = false;  // trans2: light passes, as Trans has it
  double transmissivity = 0, transmittedSpecular = 0;
  int32_t functions = -1;
};
// ashik2: the higher the powers, the smoother. Diffuse and specular colour add up.
struct Ashikhmin {
  Rgb diffuse, specular;
  double powerAlong = 0, powerAcross = 0;
  int32_t functions = -1;
};
// plasfunc, metfunc, transfunc, plasdata, metdata and transdata: what is specular is scattered as a function
// of the direction to a light source says.
struct FunctionScatterer {
  Rgb color;
  double specularity = 0;
  bool metal = false;
  double transmissivity = 0, transmittedSpecular = 0;
  int32_t functions = -1;
};
// BRTDfunc. What functions say is known here as far as numbers are given in their place.
struct BrtdFunction {
  Rgb diffuseFront, diffuseBack, diffuseTransmitted;
  bool transmits = true;     // sharply: a transmission is other than the word 0
  bool directional = true;   // there are distribution functions
  double mostReflected = 1;  // sharply, by either side; 1 where functions decide
  double mostTransmitted = 1;
  int32_t functions = -1;
};
// WGMDfunc: trans2 with modifiers and functions of its own for each component.
struct WgmdFunction {
  // The most that a lobe may hold, and its least roughness: 1 and 0 where functions decide.
  struct Lobe {
    double share = 1, roughnessAlong = 0, roughnessAcross = 0;
    std::optional<int32_t> modifier;  // index in Scene::modifiers or -1 (void); empty: the material's own
  };
  Rgb diffuseFront, diffuseBack, diffuseTransmitted;
  Lobe reflected, transmitted;
  std::optional<int32_t> diffuseTransmittedModifier;
  bool transmits = true;  // the specular transmission is other than the word 0
  int32_t functions = -1;
};

// BSDF and aBSDF: scattering from an XML file, and diffuse colours added to it.
struct BsdfMaterial {
  bool aperture = false;  // aBSDF: what goes straight on is told apart
  bool proxy = false;     // BSDF with a thickness other than the word 0: stands for geometry that it hides
  Rgb diffuseFront{0, 0, 0}, diffuseBack{0, 0, 0}, diffuseTransmitted{0, 0, 0};
  int32_t functions = -1;
};

// What a surface is to rays that it does not concern (illum, mirror).
struct Alternate {
  enum class Kind : uint8_t { none, pass, modifier } kind = Kind::none;
  int32_t modifier = -1;  // index in Scene::modifiers, for Kind::modifier
};
struct Mirror {
  Rgb reflectance;
  Alternate alternate;
};

// prism1 and prism2: what is seen in a plane surface comes from one or two directions that functions say.
struct Prism {
  int images = 1;
  int32_t functions = -1;
};
// Between its front and its back, surfaces of some modifiers are not there. cut: shades the places where its
// back cuts through a volume that they enclose; Kind::pass leaves those open.
struct Antimatter {
  uint64_t clips = 0;  // those modifiers, as Surface::clip has them
  Alternate cut{Alternate::Kind::pass};
};
// A volume that absorbs and scatters light. sources: whose light is scattered, as "mirror>lamp" by way of a
// relay.
struct Mist {
  Rgb extinction{0, 0, 0};                          // per unit length, on top of what the medium around has
  bool hasAlbedo = false, hasEccentricity = false;  // else those of the medium around hold
  Rgb albedo{0, 0, 0};                              // share of the extinction that is scattered
  double eccentricity = 0;                          // of Henyey and Greenstein's phase function
  std::vector<std::string> sources;
  uint32_t number = 0;  // among the scene's mists
};

struct Light {
  Rgb radiance;  // W/sr/m2
};
struct Illum {
  Rgb radiance;
  Alternate alternate;  // Kind::none passes rays too
};
// reach: farther than this it is no light source but lights by chance (as seen by indirect rays); negative:
// it never lights, it is only seen; 0: it is always indirect.
struct Glow {
  Rgb radiance;
  double reach = 0;
};
struct Spotlight {
  Rgb radiance;
  double solidAngle = 0;  // of the cone, sr
  V3d aim{0, 0, 1};       // unit
  double focalLength =
      0;  // length of the aim vector as given: the light comes from this far behind the surface
};

using Material = std::variant<Opaque, Trans, Anisotropic, Ashikhmin, FunctionScatterer, BrtdFunction,
                              WgmdFunction, BsdfMaterial, Dielectric, Interface, Glass, Mirror, Prism,
                              Antimatter, Mist, Light, Illum, Glow, Spotlight>;

}  // namespace rsphere
