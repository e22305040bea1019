#pragma once
#include <string>

namespace rsphere {

// Definitions that all function files see: the expression of -e, or the file of -f.
struct SharedDefinitions {
  bool isFile = false;
  std::string text;  // the expression, or the name of the file, which is searched for along RAYPATH
};

}  // namespace rsphere
