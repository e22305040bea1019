#pragma once
// Contributors: goals and light sources whose light can be told apart in an answer.
#include <span>
#include <string>

#include "scene/scene.h"

namespace rsphere {

// Makes goals (-Sg) of the surfaces whose modifier has one of these names: they emit importance 1, and every
// other source is dark. Without names, the scene has no goals. Throws rad::Error if no surface has a name.
void setGoals(Scene& scene, std::span<const std::string> goals);

// The most contributors of a scene.
inline constexpr size_t kMostContributors = 1000;

// Gives the light of each contributor a part of its own in each color (BandScheme::ofContributors), and sets
// Scene::contributors. They are the goals in the order of `goals`, which setGoals() got; without goals, the
// modifiers of type light, illum, glow and spotlight that emit, in the order of the scene. Modifiers with the
// same name are one contributor. Throws rad::Error if there is none, or more than kMostContributors, or if a
// goal is named twice.
void separateContributors(Scene& scene, std::span<const std::string> goals);

}  // namespace rsphere
