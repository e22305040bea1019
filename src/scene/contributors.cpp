#include "scene/contributors.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/band_scheme.h"
#include "rad_parser/error.h"
#include "rad_parser/printable.h"
#include "scene/modifier_names.h"

namespace rsphere {
namespace {

size_t positionOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<size_t>(std::ranges::find(names, name) - names.begin());
}

// The emission of a material; null if it is not a light source.
Color* emissionOf(Modifier& modifier) {
  auto* const material = std::get_if<Material>(&modifier.content);
  if (!material) return nullptr;
  return std::visit(
      [](auto& kind) -> Color* {
        if constexpr (requires { kind.radiance; }) return &kind.radiance;
        return nullptr;
      },
      *material);
}

// The modifiers that emit light, in the order of the scene.
std::vector<Modifier*> emittersOf(Scene& scene) {
  std::vector<Modifier*> emitters;
  for (Modifier& modifier : scene.modifiers) {
    const Color* const emission = emissionOf(modifier);
    if (emission && !isBlack(*emission)) emitters.push_back(&modifier);
  }
  std::ranges::stable_sort(emitters, {}, [](const Modifier* m) { return m->primitive.index(); });
  return emitters;
}

}  // namespace

void setGoals(Scene& scene, std::span<const std::string> goals) {
  for (Finish& finish : scene.surfaces.finishes())
    finish.goal = std::ranges::find(goals, finish.name) != goals.end();
  for (const std::string& goal : goals) {
    const auto isOne = [&](const Surface& surface) { return surface.goal && surface.finish.name == goal; };
    if (goal == "void" || std::none_of(scene.surfaces.begin(), scene.surfaces.end(), isOne))
      throw rad::Error(fmt::format("no surface has the goal's modifier \"{}\"{}", rad::printable(goal),
                                   hintOfModifier(scene, goal)));
  }
  scene.importance = !goals.empty();
}

void separateContributors(Scene& scene, std::span<const std::string> goals) {
  std::vector<std::string> names;
  const auto addGoal = [&](const std::string& goal) {
    if (positionOf(names, goal) < names.size())
      throw rad::Error(fmt::format("-Sg {}: the goal is given twice", goal));
    names.push_back(goal);
  };
  std::ranges::for_each(goals, addGoal);
  for (const Finish& finish : scene.surfaces.finishes())
    if (finish.sensor) addGoal(finish.name);
  const bool ofLamps = names.empty();
  if (ofLamps)
    for (const Modifier* modifier : emittersOf(scene))
      if (const std::string& name = modifier->decoded.name; positionOf(names, name) == names.size())
        names.push_back(name);
  if (names.empty()) throw rad::Error("-Sp: the scene has neither goals (-Sg) nor light sources");
  if (names.size() > kMostContributors)
    throw rad::Error(
        fmt::format("-Sp: {} contributors, but at most {} are possible", names.size(), kMostContributors));
  const BandScheme& parts = partsOf(names.size());
  for (Finish& finish : scene.surfaces.finishes())
    if (finish.goal)
      finish.importance = Radiance(
          Color::ofContributor(finish.importance.color.rgb(), positionOf(names, finish.name), parts));
  if (ofLamps)
    for (Modifier* modifier : emittersOf(scene)) {
      Color& emission = *emissionOf(*modifier);
      emission = Color::ofContributor(emission.rgb(), positionOf(names, modifier->decoded.name), parts);
    }
  scene.contributors = std::move(names);
}

}  // namespace rsphere
