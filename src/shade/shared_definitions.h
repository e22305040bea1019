#pragma once
#include <string>

namespace rsphere {

// Definitions visible to all function files: the expression of -e, or the file of -f.
struct SharedDefinitions {
  bool isFile = false;
  std::string text;  // the expression, or the name of the file, searched for along RAYPATH
};

}  // namespace rsphere
