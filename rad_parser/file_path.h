#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// Where library files are looked for: the environment's RAYPATH, directories separated by ':'; without it
// ".", then "/usr/local/lib/ray". An empty directory is the current one.
std::string libraryPath();

// Which files a scene may name. Anywhere on the machine, or, where the scene comes from a stranger (-Sc-),
// regular files in the folders that it was given: of the files named when it was made, and of RAYPATH; or in
// folders below them. Symbolic links are followed first, so that none leads out.
class FileAccess {
 public:
  FileAccess() = default;
  // given: names as the command line has them; each is looked for as it stands and along RAYPATH.
  static FileAccess foldersOf(std::span<const std::string> given);

  bool allows(const std::string& path) const;
  // What a message about a file that is not found has to add: which files are allowed, unless all are, or
  // where a file of this name was looked for along RAYPATH. Empty where neither limits it.
  std::string remark(std::string_view name = {}) const;

 private:
  std::optional<std::vector<std::string>> folders_;  // without links; each ends with '/'
};

// Finds a readable file as rtrace(1) and xform(1) do. A name that begins with '/' or '.' is taken as it
// stands, one that begins with '~' starts in a home directory ("~/a", "~user/a"), every other is looked for
// in each directory of searchPath in turn. Relative names and directories start at `base` (empty: the current
// directory). Returns the path to open, relative where the name was; empty where no readable file is found,
// or none that access allows.
std::optional<std::string> findFile(std::string_view name, std::string_view searchPath,
                                    std::string_view base = {}, const FileAccess& access = {});

// name as seen from the current directory where it was given as seen from base. Absolute names stay.
std::string joinPath(std::string_view base, std::string_view name);

// The path up to its last '/', without it ("/" for a file there); empty where there is none.
std::string directoryOf(std::string_view path);

}  // namespace rad
