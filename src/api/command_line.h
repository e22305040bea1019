#pragma once
#include <string>

#include "cli/options.h"
#include "rsphere/options.h"

namespace rsphere::v1 {

// What calls of the library answer.
enum class Records { rays, points, glare, contributions };

// The options of a call as the command's parser reads them.
struct CommandOptions {
  rsphere::Options options;  // for binary output
  // Equal if the answers are, and how they are written: the words of the command line.
  std::string key;
  // Equal if the same preparations of the scene serve both: the words without those of threads and output.
  std::string sceneKey;
};

// Throws rad::Error as the parser does, and if an option has no meaning in the library.
CommandOptions commandOptions(const Options& options, Records records);

}  // namespace rsphere::v1
