#include "answer/load_scene.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "scene/contributors.h"

namespace rsphere {

Scene loadScene(const AnswerOptions& options, const rad::Warn& warn) {
  rad::ReadOptions read{options.commands, warn};
  if (!options.commands) {
    std::vector<std::string> named = options.scene;
    for (const SharedDefinitions& shared : options.ray.definitions)
      if (shared.isFile) named.push_back(shared.text);
    read.files = rad::FileAccess::foldersOf(named);
  }
  Scene scene = buildScene(rad::readScene(options.scene, read), read, options.goals);
  if (options.separate) separateContributors(scene, options.goals);
#ifdef __GLIBC__
  // The lists of a large scene have grown by moving, which leaves holes of megabytes.
  malloc_trim(0);
#endif
  return scene;
}

}  // namespace rsphere
