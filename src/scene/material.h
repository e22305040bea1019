#pragma once
#include <cstdint>
#include <variant>

#include "cli/rgb.h"

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

// What a surface is to rays that it does not concern (illum, mirror).
struct Alternate {
  enum class Kind : uint8_t { none, pass, modifier } kind = Kind::none;
  int32_t modifier = -1;  // index in Scene::modifiers, for Kind::modifier
};
struct Mirror {
  Rgb reflectance;
  Alternate alternate;
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

using Material =
    std::variant<Opaque, Trans, Dielectric, Interface, Glass, Mirror, Light, Illum, Glow, Spotlight>;

}  // namespace rsphere
