#include "trace/refracting.h"

#include <optional>

namespace rsphere {
namespace {

class Refracting {
 public:
  explicit Refracting(const Scene& scene)
      : scene_(scene), modifiers_(scene.modifiers.size()), groups_(scene.groups.size()) {}

  bool surface(const Surface& s) {
    const bool isOne = scene_.hasOwnModifier(s);
    if (const auto* instance = std::get_if<Instance>(&s.shape); instance && !isOne)
      return group(instance->group);
    if (const auto* mesh = std::get_if<MeshInstance>(&s.shape); mesh && !isOne) {
      for (const SurfaceId faces : scene_.meshes[mesh->mesh].facesOf)
        if (faces != kNone && modifier(scene_.surfaces[faces].modifier)) return true;
      return false;
    }
    return modifier(s.modifier);
  }

 private:
  // A chain of modifiers. Each is examined once, because nested mixtures may name the same ones many times.
  bool modifier(ModifierId first) {
    for (ModifierId m = first; m != kNone; m = scene_.modifiers[m].next) {
      std::optional<bool>& known = modifiers_[m];
      if (!known) {
        const Content& content = scene_.modifiers[m].content;
        bool refracts = false;
        if (const auto* mixture = std::get_if<Mixture>(&content))
          refracts = modifier(mixture->foreground) || modifier(mixture->background);
        else if (const auto* material = std::get_if<Material>(&content))
          refracts = std::visit([this](const auto& kind) { return refractsAs(kind); }, *material);
        known = refracts;
      }
      if (*known) return true;
    }
    return false;
  }

  bool refractsAs(const Dielectric&) { return true; }
  bool refractsAs(const Interface&) { return true; }
  bool refractsAs(const Mirror& mirror) { return alternate(mirror.alternate); }
  bool refractsAs(const Illum& illum) { return alternate(illum.alternate); }
  bool refractsAs(const Antimatter& antimatter) { return alternate(antimatter.cut); }
  template <class Other>
  bool refractsAs(const Other&) {
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
