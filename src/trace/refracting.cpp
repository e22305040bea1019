#include "trace/refracting.h"

#include <optional>

#include "base/overloaded.h"

namespace rsphere {
namespace {

class Refracting {
 public:
  explicit Refracting(const Scene& scene)
      : scene_(scene), modifiers_(scene.modifiers.size()), groups_(scene.groups.size()) {}

  bool surface(const Surface& s) {
    if (scene_.hasOwnModifier(s)) return modifier(s.modifier);
    return match(
        s.shape, [&](const Instance& instance) { return group(instance.group); },
        [&](const MeshInstance& mesh) {
          for (const SurfaceId faces : scene_.meshes[mesh.mesh].facesOf)
            if (faces != kNone && modifier(scene_.surfaces[faces].modifier)) return true;
          return false;
        },
        [&](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) {
          return modifier(s.modifier);
        });
  }

 private:
  // A chain of modifiers. Each modifier is examined once, because nested mixtures may name the same one many
  // times.
  bool modifier(ModifierId first) {
    for (ModifierId m = first; m != kNone; m = scene_.modifiers[m].next) {
      std::optional<bool>& known = modifiers_[m];
      if (!known) {
        known = match(
            scene_.modifiers[m].content,
            [&](const Mixture& mixture) {
              return modifier(mixture.foreground) || modifier(mixture.background);
            },
            [&](const Material& material) {
              return isBoundary(material) || alternate(alternateOf(material).value_or(Alternate{}));
            },
            [](const OneOf<Pattern, Texture> auto&) { return false; });
      }
      if (*known) return true;
    }
    return false;
  }

  bool alternate(const Alternate& a) { return a.kind == Alternate::Kind::modifier && modifier(a.modifier); }

  bool group(uint32_t g) {
    if (groups_[g]) return *groups_[g];
    bool refracts = false;
    const SurfaceGroup& group = scene_.groups[g];
    for (const SurfaceId i : group.surfaces)
      if (!refracts) refracts = surface(scene_.surfaces[i]);
    groups_[g] = refracts;
    return refracts;
  }

  const Scene& scene_;
  // Empty: not examined yet.
  ById<ModifierId, std::optional<bool>> modifiers_;
  std::vector<std::optional<bool>> groups_;
};

}  // namespace

ById<SurfaceId, bool> refractingSurfaces(const Scene& scene) {
  Refracting refracting(scene);
  ById<SurfaceId, bool> result(scene.surfaces.size());
  for (const SurfaceId i : result.ids()) result[i] = refracting.surface(scene.surfaces[i]);
  return result;
}

}  // namespace rsphere
