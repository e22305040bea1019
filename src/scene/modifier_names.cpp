#include "scene/modifier_names.h"

#include <fmt/format.h>

#include <unordered_set>

#include "rad_parser/nearest_name.h"
#include "rad_parser/printable.h"

namespace rsphere {

std::string hintOfModifier(const Scene& scene, std::string_view name) {
  for (const Surface& surface : scene.surfaces)
    if (scene.surfaceName(surface) == name)
      return fmt::format("; the surface \"{}\" has the modifier \"{}\"", rad::printable(name),
                         rad::printable(scene.modifierName(surface)));
  rad::NearestName nearest(name);
  for (const Finish& finish : scene.surfaces.finishes()) nearest.consider(finish.name);
  return nearest.hint();
}

void warnOfMissingModifiers(const Scene& scene, std::span<const std::string> names, std::string_view option,
                            const rad::Warn& warn) {
  if (!warn || names.empty()) return;
  std::unordered_set<std::string_view> known;
  for (const Finish& finish : scene.surfaces.finishes()) known.insert(finish.name);
  const std::string* first = nullptr;
  size_t missing = 0;
  for (const std::string& name : names)
    if (!known.contains(name) && missing++ == 0) first = &name;
  if (missing == 0) return;
  warn(fmt::format("no surface has the modifier \"{}\"{}{}{}", rad::printable(*first),
                   option.empty() ? "" : fmt::format(" ({})", option),
                   missing == 1 ? "" : fmt::format(", nor {} more of {}", missing - 1, names.size()),
                   hintOfModifier(scene, *first)));
}

}  // namespace rsphere
