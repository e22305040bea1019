#pragma once
// What materials are like, by type and arguments, before patterns and textures. A new type of material does
// not compile until each question has an answer for it.
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/radiometry.h"
#include "scene/material.h"

namespace rsphere {

// Whether a ray can pass the material. Used to choose between coincident surfaces, and to decide which
// surfaces can cast full shadows.
bool isTransparent(const Material& material);

// The sides on which the material certainly stops every shadow ray. Opaque materials stop them from behind
// only if back faces are visible (-bv), which is not part of the answer. A light source stops rays to other
// sources from both sides, regardless of -bv. So do prisms and materials with functions. Whether an
// alternate or antimatter stops a ray is only known at the hit.
struct Sides {
  bool front = false, back = false;
};
Sides stopsShadows(const Material& material);

// Whether the material refracts rays: it is the boundary between two media.
bool isBoundary(const Material& material);

// Whether its surfaces only enclose a volume and neither reflect nor emit light: antimatter, mist.
bool enclosesVolume(const Material& material);

// The alternate material of mirror and illum, and the cut of antimatter; empty for other materials.
std::optional<Alternate> alternateOf(const Material& material);

// ---- light

// Light, illum, glow and spotlight.
bool isLightSource(const Material& material);
// The radiance of a source material, as its arguments give it (W/sr/m2); empty for other materials.
std::optional<Radiance> sourceRadiance(const Material& material);
// Whether surfaces of the material are sampled as light sources (next-event estimation): it emits light, and
// is not glow whose reach is zero or negative.
bool isSampled(const Material& material);
// Glow::reach (world units); 0, which means no limit, for all other materials.
double reachOf(const Material& material);

// How a distant source of the material combines with other distant sources in the same direction.
enum class Cover : uint8_t {
  hides,   // the others are not seen
  yields,  // it is seen only if no other source hides it; glow
  passes   // the others are seen through it; illum without an alternate material
};
Cover coverOf(const Material& material);

// The number of images of each light source by which a plane surface of the material sends its light on, as
// virtual sources: 1 for mirror, 1 or 2 for prisms, 0 for other materials.
int imagesMadeBy(const Material& material);

// ---- reflection. How irregular a material is, which sets the number of directions towards it, is a question
// of importance/special_objects.h.

// The specular reflection of a surface's front, if it may show a sharp image of the surroundings. Callers
// decide for themselves up to which roughness there is an image, at which angle to evaluate Fresnel's
// equations, and whether to use `share` or `brightness`.
struct MirrorReflection {
  // Reflected fraction of the light. For a metal, before its color is applied; for mirror, in the channel
  // with the largest reflectance. Not set for clear materials, whose reflectance depends on the angle.
  double share = 0;
  double brightness = 0;   // the same for the brightness of white light, with all colors
  double roughness = 0;    // rms slope of the facets
  int boundaries = 0;      // of clear materials: the number of boundaries that reflect; 0: not clear
  bool frontOnly = false;  // the back reflects nothing
};
// Empty for materials that mirror nothing, for those whose highlights are always wide, and for those whose
// reflection is given by functions or data.
std::optional<MirrorReflection> mirrorReflection(const Material& material);

// The diffuse reflection of both sides of an opaque material without functions: `share` of the light, in this
// color. Empty for all other materials.
struct DiffuseReflection {
  Color color;
  double share = 0;
};
std::optional<DiffuseReflection> diffuseReflection(const Material& material);

// An argument that makes more light leave a surface of the material than arrives there: its `value`, in the
// channel where it is largest, exceeds `most` by more than kRoundedArgument. No real material does this, and
// with several bounces the light grows without limit. Empty if there is none. Functions and data of
// materials, light sources, volumes and prisms are not checked.
struct Excess {
  std::string_view argument;  // "reflectance", "specularity", "transmissivity" (also that of a length)
  double value = 0, most = 1;
};
std::optional<Excess> excessOf(const Material& material);

// Programs write arguments with three digits or more.
inline constexpr double kRoundedArgument = .001;

}  // namespace rsphere
