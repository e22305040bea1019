#include "cli/read_options.h"

namespace rsphere {

rad::ReadOptions readOptions(const Options& options, rad::Warn warn) {
  rad::ReadOptions read{options.commands, std::move(warn)};
  if (options.commands) return read;
  std::vector<std::string> given = options.scene;
  for (const SharedDefinitions& shared : options.ray.definitions)
    if (shared.isFile) given.push_back(shared.text);
  read.files = rad::FileAccess::foldersOf(given);
  return read;
}

}  // namespace rsphere
