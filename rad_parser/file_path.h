#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// The directories in which library files are searched, separated by ':'. This is the environment variable
// RAYPATH or, if it is not set, ".:/usr/local/lib/ray". An empty directory is the current one.
std::string libraryPath();

// The files that a scene may name: by default all files of the machine; for untrusted scenes (-Sc-), regular
// files in or below the folders of the given files and of RAYPATH. Symbolic links are resolved before the
// test, so that none leads out of these folders.
class FileAccess {
 public:
  FileAccess() = default;
  // given: names from the command line. Each is used as it is, and also searched along RAYPATH.
  static FileAccess foldersOf(std::span<const std::string> given);

  bool allows(const std::string& path) const;
  // The end of a message about a file that was not found: the allowed folders, if files are restricted; or
  // the folders in which a file of this name is searched. inScene: a scene file names it, so that its own
  // folder is one of them. May be empty.
  std::string remark(std::string_view name = {}, bool inScene = false) const;

 private:
  std::optional<std::vector<std::string>> folders_;  // links resolved; each ends with '/'
};

// Finds a readable file like rtrace(1) and xform(1). A name that begins with '/' or '.' is used as it is. A
// name that begins with '~' is relative to a home directory ("~/a", "~user/a"). Any other name is searched in
// the directories of searchPath, in order. Relative names and directories are relative to `base`; if it is
// empty, to the current directory. Returns the path to open, which is relative if the name was. Empty if
// there is no readable file, or none that `access` allows.
std::optional<std::string> findFile(std::string_view name, std::string_view searchPath,
                                    std::string_view base = {}, const FileAccess& access = {});

// The path from the current directory to a file whose name is relative to `base`. Absolute names are returned
// unchanged.
std::string joinPath(std::string_view base, std::string_view name);

// The part of the path before its last '/' ("/" for a file in the root directory). Empty if there is no '/'.
std::string directoryOf(std::string_view path);

}  // namespace rad
