#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rad_parser/binary/mesh_file.h"
#include "rad_parser/description.h"
#include "scene/ids.h"
#include "scene/material.h"
#include "scene/material_questions.h"
#include "scene/modifier_arguments.h"
#include "scene/placement.h"
#include "scene/shape.h"
#include "scene/surface_list.h"

namespace rsphere {

// Multiplies the color of the materials that follow it in the chain.
struct Pattern {};
// Perturbs the normal.
struct Texture {};
// Shades a surface with a blend of two chains of modifiers. kNone: void.
struct Mixture {
  ModifierId foreground, background;
};

using Content = std::variant<Material, Pattern, Texture, Mixture>;

// A modifier that some surface uses, and the next modifier in its chain (kNone: void).
struct Modifier {
  Content content;
  // Arguments of patterns, textures, mixtures and materials with `functions`; null for others. The files that
  // they name are read, and functions compiled, when the modifier is first evaluated:
  // shade/surface_functions.h.
  std::shared_ptr<const EvaluatedArguments> arguments;
  ModifierId next;
  PrimitiveId primitive;   // in Scene::description; for an alias, that of its target
  rad::Primitive decoded;  // that primitive decoded, which saves time for each ray
};

// Surfaces that share a coordinate system and are traced together: those of the scene itself, or of an
// octree, which is stored only once for all its instances.
struct SurfaceGroup {
  IdRange<SurfaceId> surfaces;
};

// A mesh file, stored only once for all its instances.
struct Mesh {
  rad::Mesh data;                  // of its materials only the bounding cube remains; the rest is in
                                   // Scene::description
  std::vector<SurfaceId> facesOf;  // by index of the mesh's material: its MeshFaces, or kNone
};

// A scene prepared for tracing. It has only the modifiers that are used and the surfaces that can be hit.
struct Scene {
  rad::FileAccess files;             // the files that modifiers may name
  rad::Description description;      // of the scene, followed by octrees and meshes; without vertices, see
                                     // below
  SurfaceList surfaces;              // of each group in turn, then the MeshFaces
  std::vector<SurfaceGroup> groups;  // [0]: the scene itself
  std::vector<Mesh> meshes;
  std::vector<Placement> placements;
  std::vector<V3d> vertices;  // of all polygons, including those without area
  ById<ModifierId, Modifier> modifiers;
  // Names of the surfaces, if there are at most kFewSurfaces. It saves decoding a name, which in such a scene
  // would take a quarter of the time of a ray.
  ById<SurfaceId, std::string> names;
  static constexpr size_t kFewSurfaces = 20000;
  bool importance = false;  // whether there are goals: importance is traced, and all other sources are dark
  // The modifiers whose light is reported separately (contributors.h); empty: none.
  std::vector<std::string> contributors;

  // The surfaces that belong to no octree or mesh. They come first.
  SurfaceList::Beginning outermost() const { return surfaces.first(outermostIds().size()); }
  IdRange<SurfaceId> outermostIds() const {
    return groups.empty() ? IdRange<SurfaceId>() : groups[0].surfaces;
  }
  // samePlaceIn() of the scene itself: kSamePlace unless the scene is small.
  double samePlace = kSamePlace;
  // The total area of these surfaces, counting one side of each (square world units), without instances and
  // meshes.
  double area() const;
  // The composition of all placements on the path; the identity for an empty path.
  Placement placementOf(const PlacementPath& path) const;
  // Whether the surface has a modifier. An instance or a mesh with a modifier applies it to all
  // of its contents.
  bool hasOwnModifier(const Surface& s) const { return s.finish.described != rad::kVoid; }
  // The name of a surface. In scenes of more than kFewSurfaces it is decoded, which takes .1 microseconds.
  std::string surfaceName(const Surface& s) const;
  // The material (as Finish::material) of the chain that starts with this modifier.
  ModifierId firstMaterial(ModifierId modifier) const;
  // Null for kNone, and if the modifier is not a material.
  const Material* materialAt(ModifierId modifier) const {
    return modifier == kNone ? nullptr : std::get_if<Material>(&modifiers[modifier].content);
  }
  // Null if the surface has no material, or only mixtures.
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
