#pragma once
#include <optional>
#include <string_view>

#include "rad_parser/calc/library.h"
#include "rad_parser/file_path.h"

namespace rsphere {

// Finds a function file along RAYPATH and reads it; used as calc::LoadFile. Empty if there is none that
// `access` allows. Throws rad::Error (Status::system) if it is a folder or cannot be read.
std::optional<rad::calc::SourceText> loadFunctionFile(std::string_view name, const rad::FileAccess& access);

}  // namespace rsphere
