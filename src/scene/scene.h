#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rad_parser/description.h"
#include "rad_parser/mesh_file.h"
#include "scene/ids.h"
#include "scene/material.h"
#include "scene/material_questions.h"
#include "scene/modifier_arguments.h"
#include "scene/placement.h"
#include "scene/shape.h"
#include "scene/surface_list.h"

namespace rsphere {

// Multiplies the colour of the materials behind it.
struct Pattern {};
// Perturbs the normal.
struct Texture {};
// Shades a surface with a blend of two chains of modifiers. kNone: void.
struct Mixture {
  ModifierId foreground, background;
};

using Content = std::variant<Material, Pattern, Texture, Mixture>;

// A modifier that some surface uses, and the modifier that modifies it in turn (kNone: void).
struct Modifier {
  Content content;
  // Of patterns, textures, mixtures and the materials with `functions`; null for others. Files that they name
  // are read, and functions compiled, when the modifier is first evaluated: shade/surface_functions.h.
  std::shared_ptr<const EvaluatedArguments> arguments;
  ModifierId next;
  PrimitiveId primitive;   // in Scene::description; of the target if it was an alias
  rad::Primitive decoded;  // that primitive, so that no ray has to decode it
};

// Surfaces that share one coordinate system and are traced together: the scene itself, or an octree, which is
// stored once however many instances of it there are.
struct SurfaceGroup {
  IdRange<SurfaceId> surfaces;
};

// A mesh file, stored once however many instances of it there are.
struct Mesh {
  rad::Mesh data;                  // its materials keep only the cube; the rest is in Scene::description
  std::vector<SurfaceId> facesOf;  // by material of data: its MeshFaces, or kNone
};

// A scene prepared for tracing. It has only the modifiers that are used and the surfaces that can be hit.
struct Scene {
  rad::FileAccess files;             // the files that its modifiers may name
  rad::Description description;      // the scene's, then those of octrees and meshes; the vertices are moved
  SurfaceList surfaces;              // those of each group in turn, then the MeshFaces
  std::vector<SurfaceGroup> groups;  // [0]: the scene itself
  std::vector<Mesh> meshes;
  std::vector<Placement> placements;
  std::vector<V3d> vertices;  // of the polygons, also of those that have no area
  ById<ModifierId, Modifier> modifiers;
  // Names of the surfaces, if there are at most kFewSurfaces. In such a scene, decoding a name takes a
  // quarter of the time of a ray.
  ById<SurfaceId, std::string> names;
  static constexpr size_t kFewSurfaces = 20000;
  bool importance = false;  // there are goals: importance is traced, and all other sources are dark
  // The modifiers whose light has a part of its own (contributors.h); empty: light is not divided.
  std::vector<std::string> contributors;

  // The surfaces that belong to the world itself rather than to an octree or a mesh. They are the first ones.
  SurfaceList::Beginning outermost() const { return surfaces.first(outermostIds().size()); }
  IdRange<SurfaceId> outermostIds() const {
    return groups.empty() ? IdRange<SurfaceId>() : groups[0].surfaces;
  }
  // The total area of these surfaces, one side of each (square world units). Instances and meshes are not
  // included.
  double area() const;
  // The composition of all placements on the path; the identity for an empty path.
  Placement placementOf(const PlacementPath& path) const;
  // Whether the surface has a modifier. An instance or a mesh with a modifier applies it to all
  // of its contents.
  bool hasOwnModifier(const Surface& s) const { return s.finish.described != rad::kVoid; }
  // In scenes of more than kFewSurfaces it is decoded, which takes a tenth of a microsecond.
  std::string surfaceName(const Surface& s) const;
  // Finish::material of the chain that a modifier begins.
  ModifierId firstMaterial(ModifierId modifier) const;
  // Null for kNone, and if the modifier is not a material.
  const Material* materialAt(ModifierId modifier) const {
    return modifier == kNone ? nullptr : std::get_if<Material>(&modifiers[modifier].content);
  }
  // Null if the surface has no material, or if mixtures alone determine it.
  const Material* materialOf(const Surface& s) const { return materialAt(s.material); }
  // As -om and -oM print them: "void" if there is none.
  std::string_view modifierName(const Surface& s) const;
  std::string_view materialName(const Surface& s) const;
  // 'room.rad:12: plastic "wall"', for messages.
  std::string place(PrimitiveId primitive) const;
  std::string place(const Surface& s) const { return place(surfaces.primitiveOf(s.id)); }
};

// The emitted radiance of a surface before patterns, W/sr/m2: 1 for a goal, black if it is not a source.
Radiance sourceRadiance(const Scene& scene, const Surface& surface);

}  // namespace rsphere
