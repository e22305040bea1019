#pragma once
// Names of modifiers that a user gives, and that surfaces may lack.
#include <span>
#include <string>
#include <string_view>

#include "rad_parser/error.h"
#include "scene/scene.h"

namespace rsphere {

// The end of a message about a name that is the modifier of no surface: if it is the name of a surface, that
// surface's modifier; otherwise the most similar modifier of a surface, or nothing. The time is proportional
// to the number of surfaces.
std::string hintOfModifier(const Scene& scene, std::string_view name);

// Warns, in one line, if some of the names are the modifier of no surface: 'no surface has the modifier
// "sopt" (-m), nor 2 others of 5; the nearest is "spot"'. option: with which the names were given; empty: not
// shown.
void warnOfMissingModifiers(const Scene& scene, std::span<const std::string> names, std::string_view option,
                            const rad::Warn& warn);

}  // namespace rsphere
