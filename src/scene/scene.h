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
#include "rad_parser/mesh_file.h"
#include "rad_parser/scene_file.h"
#include "scene/material.h"
#include "scene/placement.h"
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
  uint64_t clip = 0;         // the bit of its modifier in Antimatter::clips; 0: no antimatter names it
  bool goal = false;         // emits importance 1 from its front, besides what its material does
  bool smoothed = false;  // its modifier is called "Phong": what perturbs normals bends nothing that passes
};

// Surfaces that are traced together, in coordinates of their own: the scene itself, or an octree that
// instances bring in, once in memory however many they are.
struct SurfaceGroup {
  uint32_t firstSurface = 0, surfaces = 0;  // range in Scene::surfaces
};

// A mesh file, once in memory.
struct Mesh {
  rad::Mesh data;                // materials: the cube alone; the rest is part of Scene::description
  std::vector<int32_t> facesOf;  // by material of data: index in Scene::surfaces of its MeshFaces, or kNone
};

// What the tracer needs of a scene, and only what this scene requires: used modifiers, surfaces that can be
// hit.
struct Scene {
  rad::FileAccess files;             // those that its modifiers may name
  rad::Description description;      // of octrees and meshes too, behind the scene's own; without the
                                     // surfaces' numbers
  std::vector<Surface> surfaces;     // by groups, then the MeshFaces
  std::vector<SurfaceGroup> groups;  // [0]: the scene itself
  std::vector<Mesh> meshes;
  std::vector<Placement> placements;
  std::vector<V3d> vertices;  // of the polygons
  std::vector<Modifier> modifiers;
  bool importance = false;  // there are goals: importance is traced, and every other source is dark

  // The surfaces that are in the world rather than in an octree or a mesh: the first ones.
  std::span<const Surface> outermost() const {
    return std::span(surfaces).first(groups.empty() ? 0 : groups[0].surfaces);
  }
  // Of all on the path together; placements of an empty one leave everything where it is.
  Placement placementOf(const PlacementPath& path) const;
  // Whether the surface has a modifier of its own: an instance or a mesh then stands for all that it brings
  // in.
  bool hasOwnModifier(const Surface& s) const {
    return description.primitives[s.primitive].modifier != rad::kVoid;
  }
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
// What a surface is given to send, W/sr/m2, before patterns: 1 of a goal, black where it is no source.
Rgb sourceRadiance(const Scene& scene, const Surface& surface);

// Checks and converts what surfaces use of the description, which is kept for names and places, and reads the
// octrees and meshes that it names (options: for them), each once. Vertices are as the files have them
// (double precision). Warns of what RADIANCE warns of (negative radii, surfaces without area, vertices out of
// the plane); a surface without area is left out, and so are distant sources in octrees. Throws rad::Error
// with the primitive's place: wrong arguments, a used type that is not supported yet, mixtures nested beyond
// reason, octrees within themselves or deeper than PlacementPath::kDeepest, what rad::readOctree() and
// rad::readMesh() throw. Or that no surface has the modifier of a goal: surfaces with a modifier of one of
// these names emit importance (-Sg).
Scene buildScene(rad::Description description, const rad::ReadOptions& options = {},
                 std::span<const std::string> goals = {});

}  // namespace rsphere
