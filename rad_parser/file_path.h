#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace rad {

// Where library files are looked for: the environment's RAYPATH, directories separated by ':'; without it
// ".", then
// "/usr/local/lib/ray". An empty directory is the current one.
std::string libraryPath();

// Finds a readable file as rtrace(1) and xform(1) do. A name that begins with '/' or '.' is taken as it
// stands, one that begins with '~' starts in a home directory ("~/a", "~user/a"), every other is looked for
// in each directory of searchPath in turn. Relative names and directories start at `base` (empty: the current
// directory). Returns the path to open, relative where the name was; empty where no readable file is found.
std::optional<std::string> findFile(std::string_view name, std::string_view searchPath,
                                    std::string_view base = {});

// name as seen from the current directory where it was given as seen from base. Absolute names stay.
std::string joinPath(std::string_view base, std::string_view name);

// The path up to its last '/', without it ("/" for a file there); empty where there is none.
std::string directoryOf(std::string_view path);

}  // namespace rad
