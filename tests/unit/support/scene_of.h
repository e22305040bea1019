#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"

namespace rsphere {

// The scene of a text, whose lines messages call room.rad:1 and so on.
inline Scene sceneOf(std::string_view text, std::vector<std::string>* warnings = nullptr) {
  const rad::Warn warn = [warnings](std::string_view line) {
    if (warnings) warnings->emplace_back(line);
  };
  return buildScene(rad::readSceneText(text, "room.rad"), {true, warn});
}

}  // namespace rsphere
