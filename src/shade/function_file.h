#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "rad_parser/calc/library.h"
#include "rad_parser/file_path.h"

namespace rsphere {

// Definitions visible to all function files: the expression of -e, or the file of -f.
struct SharedDefinitions {
  bool isFile = false;
  std::string text;  // the expression, or the name of the file, searched for along RAYPATH
};

// Finds a function file along RAYPATH and reads it, or else returns the built-in one of this name; used as
// calc::LoadFile. Empty if there is none that `access` allows. Throws rad::Error (Status::system) if it is a
// folder or cannot be read.
std::optional<rad::calc::SourceText> loadFunctionFile(std::string_view name, const rad::FileAccess& access);

}  // namespace rsphere
