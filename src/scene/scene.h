#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "scene/material.h"
#include "scene/shape.h"

namespace rsphere {

inline constexpr int32_t kNone = -1;

// Multiplies the colour of the materials behind it. What patterns, textures and mixtures compute is prepared
// when it is first asked for, from the primitive's arguments: shade/surface_functions.h.
struct Pattern {};
// Adds to the normal.
struct Texture {};
// Shades a share of a surface with one chain of modifiers and the rest with another; each an index in
// Scene::modifiers, or kNone for void.
struct Mixture {
  int32_t foreground = kNone, background = kNone;
};

using Content = std::variant<Material, Pattern, Texture, Mixture>;

// A modifier that some surface uses, itself modified by another (kNone: void).
struct Modifier {
  Content content;
  int32_t next = kNone;
  uint32_t primitive = 0;  // index in Scene::description; of the target where it was an alias
};

struct Surface {
  Shape shape;
  uint32_t primitive = 0;    // index in Scene::description: name and place
  int32_t modifier = kNone;  // index in Scene::modifiers; kNone: void
  int32_t material = kNone;  // the first material of the chain that modifier begins, or else the mixture that
                             // ends it: what ties between surfaces and light sources go by. kNone: none
  bool goal = false;         // emits importance 1 from its front, besides what its material does
};

// What the tracer needs of a scene, and only what this scene requires: used modifiers, surfaces that can be
// hit.
struct Scene {
  rad::Description description;
  std::vector<Surface> surfaces;
  std::vector<V3d> vertices;  // of the polygons
  std::vector<Modifier> modifiers;
  bool importance = false;  // there are goals: importance is traced, and every other source is dark

  std::string_view surfaceName(const Surface& s) const {
    return description.name(description.primitives[s.primitive]);
  }
  // Surface::material of the chain that a modifier begins.
  int32_t firstMaterial(int32_t modifier) const;
  // The material at an index in modifiers; null at kNone, and where there is no material.
  const Material* materialAt(int32_t modifier) const {
    return modifier == kNone ? nullptr : std::get_if<Material>(&modifiers[modifier].content);
  }
  // Null where the surface has none, and where mixtures alone decide about it.
  const Material* materialOf(const Surface& s) const { return materialAt(s.material); }
  // As -om and -oM print them: "void" where there is none.
  std::string_view modifierName(const Surface& s) const;
  std::string_view materialName(const Surface& s) const;
  // 'room.rad:12: plastic "wall"', for messages.
  std::string place(uint32_t primitive) const;
};

// Whether a ray can pass the material: what decides between coincident surfaces, and who can cast full
// shadows.
bool isTransparent(const Material& material);
// Light, illum, glow and spotlight.
bool isLightSource(const Material& material);
// The radiance a source material is given (W/sr/m2); empty for others.
std::optional<Rgb> sourceRadiance(const Material& material);

// Checks and converts what surfaces use of the description, which is kept for names and places. Vertices are
// as the files have them (world frame, double). Warns of what RADIANCE warns of (negative radii, surfaces
// without area, vertices out of the plane); a surface without area is left out. Throws rad::Error
// with the primitive's place: wrong arguments, a used type that is not supported yet, mixtures nested beyond
// reason. Or that no
// surface has the modifier of a goal: surfaces with a modifier of one of these names emit importance (-Sg).
Scene buildScene(rad::Description description, const rad::Warn& warn,
                 std::span<const std::string> goals = {});

}  // namespace rsphere
