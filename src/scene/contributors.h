#pragma once
// Contributors: goals and light sources whose light is reported separately in an answer.
#include <span>
#include <string>

#include "scene/scene.h"

namespace rsphere {

// Makes goals (-Sg) of the surfaces with these modifiers: they emit importance 1, and all other sources are
// dark. Without names, the scene has no goals. Throws rad::Error if a name is the modifier of no surface.
void setGoals(Scene& scene, std::span<const std::string> goals);

// The maximum number of contributors of a scene.
inline constexpr size_t kMostContributors = 1000;

// Divides each color into parts, one for the light of each contributor (BandScheme::ofContributors), and sets
// Scene::contributors. The contributors are the goals, in the order of `goals`, the list passed to
// setGoals(), and then the sensors (addSensors()). Without any they are the modifiers of type light, illum,
// glow and spotlight that emit, in the order of the scene. Modifiers with the same name are one contributor.
// Throws rad::Error if there are none or more than kMostContributors, or if a goal is named twice.
void separateContributors(Scene& scene, std::span<const std::string> goals);

}  // namespace rsphere
