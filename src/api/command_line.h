#pragma once
#include <string>

#include "cli/options.h"
#include "rsphere/options.h"

namespace rsphere::v1 {

// The kinds of records that calls of the library answer.
enum class Records { rays, points, glare, contributions };

// The options of a call, read by the command's parser.
struct CommandOptions {
  rsphere::Options options;  // for binary output
  // The words of the command line. If equal for two calls, their answers and output formats are equal.
  std::string key;
  // The words without those for threads and output. If equal for two calls, they can share a prepared scene.
  std::string sceneKey;
};

// Throws rad::Error like the parser, and if an option has no meaning in the library.
CommandOptions commandOptions(const Options& options, Records records);

}  // namespace rsphere::v1
