#pragma once
// Properties of materials that follow from type and arguments, before patterns and textures. A new type of
// material does not compile until each function here handles it.
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/radiometry.h"
#include "scene/material.h"

namespace rsphere {

// Whether rays can pass the material. Used to choose between coincident surfaces, and to find the surfaces
// that may block light completely.
bool isTransparent(const Material& material);

// The sides on which the material stops every shadow ray. Only the front of opaque materials is included,
// because the back stops rays only if back faces are visible (-bv). Light sources stop rays to other sources
// on both sides regardless of -bv, and so do prisms and materials with functions. Neither side of alternates
// and antimatter is included, because these are only known at the hit.
struct Sides {
  bool front = false, back = false;
};
Sides stopsShadows(const Material& material);

// Whether the material refracts rays: it is the boundary between two media.
bool isBoundary(const Material& material);

// Whether its surfaces only enclose a volume, without reflecting or emitting light: antimatter, mist.
bool enclosesVolume(const Material& material);

// The alternate material of mirror and illum, and the cut of antimatter; empty for other materials.
std::optional<Alternate> alternateOf(const Material& material);

// ---- light

// Light, illum, glow and spotlight.
bool isLightSource(const Material& material);
// The radiance of a source material according to its arguments (W/sr/m2); empty for other materials.
std::optional<Radiance> sourceRadiance(const Material& material);
// Whether surfaces of the material are sampled as light sources (next-event estimation): it emits light, and
// is not glow whose reach is zero or negative.
bool isSampled(const Material& material);
// Glow::reach (world units); 0 (no limit) for all other materials.
double reachOf(const Material& material);

// How a distant source of the material combines with other distant sources in the same direction:
enum class Cover : uint8_t {
  hides,   // the others are hidden
  yields,  // glow: it is hidden by any source that hides others
  passes   // illum without an alternate material: the others are visible through it
};
Cover coverOf(const Material& material);

// The number of images of each light source that a plane surface of the material forms as virtual sources: 1
// for mirror, 1 or 2 for prisms, 0 for other materials.
int imagesMadeBy(const Material& material);

// ---- reflection. The irregularity of a material, which determines the number of directions towards it, is
// in silhouettes/special_objects.h.

// The specular reflection of a surface's front, if it may show a sharp image of its surroundings. Callers
// choose the largest roughness with an image, the angle for Fresnel's equations, and `share` or `brightness`.
struct MirrorReflection {
  // Reflected fraction of the light. For a metal, before its color is applied; for mirror, in the channel
  // with the largest reflectance. Unset for clear materials, whose reflectance depends on the angle.
  double share = 0;
  double brightness = 0;   // reflected fraction of the brightness of white light, with all colors applied
  double roughness = 0;    // rms slope of the facets
  int boundaries = 0;      // for clear materials: number of reflecting boundaries; 0: not clear
  bool frontOnly = false;  // nothing is reflected at the back
};
// Empty for materials without mirror reflection, for those with wide highlights only, and for those whose
// reflection is defined by functions or data.
std::optional<MirrorReflection> mirrorReflection(const Material& material);

// The diffuse reflection of both sides of an opaque material without functions: the color, and the fraction
// of light to which it applies. Empty for all other materials.
struct DiffuseReflection {
  Color color;
  double share = 0;
};
std::optional<DiffuseReflection> diffuseReflection(const Material& material);

// An argument with which more light leaves a surface than arrives: its `value`, in the channel where it is
// largest, exceeds `most` by more than kRoundedArgument. No real material has such a value, and light grows
// without limit over several bounces. Empty if no argument is too large. Functions and data of materials,
// light sources, volumes and prisms are not checked.
struct Excess {
  std::string_view argument;  // "reflectance", "specularity", "transmissivity" (also that of a length)
  double value = 0, most = 1;
};
std::optional<Excess> excessOf(const Material& material);

// Tolerance for rounding: programs write arguments with at least three digits.
inline constexpr double kRoundedArgument = .001;

}  // namespace rsphere
