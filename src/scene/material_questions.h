#pragma once
// What materials are like, by type and arguments, before patterns and textures. Each question has an answer for
// each type of material: a new type that answers nowhere does not compile.
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

// What a distant source of the material does to distant sources in the same direction.
enum class Cover : uint8_t {
  hides,   // the other sources
  yields,  // to a source that hides it; glow
  passes   // their light on; illum without an alternate material
};
Cover coverOf(const Material& material);

// The number of images of each light source by which a plane surface of the material sends its light on, as
// virtual sources: 1 for mirror, 1 or 2 for prisms, 0 for other materials.
int imagesMadeBy(const Material& material);

// ---- reflection. How irregular a material is, which sets the number of directions towards it, is a question
// of importance/special_objects.h.

// The specular reflection in the front of a surface, as far as it may show a sharp image of the surroundings.
// Those who ask differ in three choices, which they make by themselves: the largest roughness that still shows
// an image, the angle at which Fresnel's equations are evaluated, and whether colors count.
struct MirrorReflection {
  // Fraction of the light. Of a metal: before its color is applied; of mirror: in the channel that it reflects
  // best. Not for clear materials, where the angle decides.
  double share = 0;
  double brightness = 0;   // the same for the brightness of white light, with all colors
  double roughness = 0;    // rms slope of the facets
  int boundaries = 0;      // of clear materials: the number of boundaries that reflect; 0: not clear
  bool frontOnly = false;  // the back reflects nothing
};
// Empty for materials that mirror nothing, whose highlights are always wide, or whose functions or data decide.
std::optional<MirrorReflection> mirrorReflection(const Material& material);

// The diffuse reflection of both sides of an opaque material without functions: `share` of the light, in this
// color. Empty for all other materials.
struct DiffuseReflection {
  Color color;
  double share = 0;
};
std::optional<DiffuseReflection> diffuseReflection(const Material& material);

// An argument by which more light leaves a surface of the material than arrives there: `value`, in the channel where it is
// largest, is above `most` by more than kRoundedArgument. Nothing in nature is so, and with several bounces light grows
// without limit. Empty if there is none. Functions and data of a material are not looked at, nor are light sources,
// volumes and prisms.
struct Excess {
  std::string_view argument;  // "reflectance", "specularity", "transmissivity" (also that of a length)
  double value = 0, most = 1;
};
std::optional<Excess> excessOf(const Material& material);

// Programs write arguments with three digits or more.
inline constexpr double kRoundedArgument = .001;

}  // namespace rsphere
