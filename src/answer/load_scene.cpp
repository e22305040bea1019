#include "answer/load_scene.h"

#include "rad_parser/scene_file.h"

namespace rsphere {

Scene loadScene(const AnswerOptions& options, const rad::Warn& warn) {
  rad::ReadOptions read{options.commands, warn};
  if (!options.commands) {
    std::vector<std::string> named = options.scene;
    for (const SharedDefinitions& shared : options.ray.definitions)
      if (shared.isFile) named.push_back(shared.text);
    read.files = rad::FileAccess::foldersOf(named);
  }
  return buildScene(rad::readScene(options.scene, read), read, options.goals);
}

}  // namespace rsphere
