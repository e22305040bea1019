#include "scene/scene.h"

#include "scene/arguments.h"

namespace rsphere {

ModifierId Scene::firstMaterial(ModifierId modifier) const {
  for (; modifier != kNone; modifier = modifiers[modifier].next) {
    const Modifier& m = modifiers[modifier];
    if (std::holds_alternative<Material>(m.content)) return modifier;
    if (m.next == kNone && std::holds_alternative<Mixture>(m.content)) return modifier;
  }
  return kNone;
}

Placement Scene::placementOf(const PlacementPath& path) const {
  if (path.count == 0) return {};
  Placement all = placements[path.placements[0]];
  for (uint8_t i = 1; i < path.count; ++i) all = within(all, placements[path.placements[i]]);
  return all;
}

double Scene::area() const {
  double area = 0;
  for (const Surface& surface : outermost()) area += areaOf(surface.shape, vertices);
  return area;
}

std::string_view Scene::modifierName(const Surface& s) const { return s.finish.name; }

std::string Scene::surfaceName(const Surface& s) const {
  return names.empty() ? description.primitives.name(surfaces.primitiveOf(s.id)) : names[s.id];
}

std::string_view Scene::materialName(const Surface& s) const {
  return s.material == kNone ? "void" : std::string_view(modifiers[s.material].decoded.name);
}

std::string Scene::place(PrimitiveId i) const { return placeOf(description, i); }

Radiance sourceRadiance(const Scene& scene, const Surface& surface) {
  if (surface.goal) return surface.finish.importance;
  const Material* material = scene.materialOf(surface);
  return material ? sourceRadiance(*material).value_or(Radiance()) : Radiance();
}

}  // namespace rsphere
