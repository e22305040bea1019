#include "answer/load_scene.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "scene/contributors.h"
#include "scene/sensors.h"

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
  addSensors(scene, options.sensors);
  if (options.separate) separateContributors(scene, options.goals);
#ifdef __GLIBC__
  // Growing lists of a large scene were moved, which leaves unused gaps of megabytes; this returns them.
  malloc_trim(0);
#endif
  return scene;
}

}  // namespace rsphere
