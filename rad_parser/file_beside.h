#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "rad_parser/description.h"
#include "rad_parser/file_path.h"

namespace rad {

// The path of a file of this relative name in the folder of the scene file at `place`; for the output of a
// command, of the file with the command. Begins with '/' or '.', so that findFile() uses it as it is. Empty
// if `access` allows no such file, and for a command that no file contains. RADIANCE does not look there: use
// it for files that are not found along RAYPATH.
std::optional<std::string> fileBeside(const Description& description, Place place, std::string_view name,
                                      const FileAccess& access);

// The name by which findFile() finds a file that a primitive names: the given one, unless the file is found
// only beside the scene file.
std::string nameOfFile(const Description& description, Place place, std::string_view name,
                       const FileAccess& access);

}  // namespace rad
