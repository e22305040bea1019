#include "rad_parser/file_path.h"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "rad_parser/printable.h"

namespace rad {
namespace {

// Replaces "~" or "~user" at the beginning of a name by the home directory. Empty if there is no such user.
std::optional<std::string> inHome(std::string_view name) {
  const size_t slash = std::min(name.find('/'), name.size());
  const std::string user(name.substr(1, slash - 1));
  const std::string rest(name.substr(slash));
  if (const char* home = std::getenv("HOME"); user.empty() && home) return home + rest;
  std::vector<char> buffer(1 << 14);
  passwd entry, *found = nullptr;
  if (user.empty())
    getpwuid_r(getuid(), &entry, buffer.data(), buffer.size(), &found);
  else
    getpwnam_r(user.c_str(), &entry, buffer.data(), buffer.size(), &found);
  if (!found) return {};
  return found->pw_dir + rest;
}

// Whether a name is used as it is, without searching along RAYPATH.
bool standsAlone(std::string_view name) { return name[0] == '/' || name[0] == '.' || name[0] == '~'; }

bool readable(const std::string& path) { return access(path.c_str(), R_OK) == 0; }

}  // namespace

FileAccess FileAccess::foldersOf(std::span<const std::string> given) {
  FileAccess access;
  std::vector<std::string>& allowed = access.folders_.emplace();
  const auto add = [&](std::filesystem::path folder) {
    std::error_code missing;
    folder = std::filesystem::canonical(folder.empty() ? "." : folder, missing);
    if (!missing) allowed.push_back((folder / "").string());
  };
  // The colon keeps an empty folder at the end, which is the current one.
  const std::string path = libraryPath(), folders = path + ':';
  for (const std::string_view folder : split(folders, ":")) add(folder);
  for (const std::string& name : given)
    if (!name.starts_with('!'))
      add(directoryOf(::access(name.c_str(), F_OK) == 0 ? name : findFile(name, path).value_or(name)));
  return access;
}

bool FileAccess::allows(const std::string& path) const {
  if (!folders_) return true;
  std::error_code missing;
  const std::filesystem::path file = std::filesystem::canonical(path, missing);
  if (missing || !std::filesystem::is_regular_file(file, missing)) return false;
  return std::ranges::any_of(*folders_,
                             [&](const std::string& folder) { return file.native().starts_with(folder); });
}

std::string FileAccess::remark(std::string_view name, bool inScene) const {
  if (folders_) return " (with -Sc- in the folders of the scene files and of RAYPATH only)";
  if (name.empty() || name[0] == '/' || name[0] == '~') return {};
  if (name[0] == '.') return inScene ? " in the current folder or beside the scene file" : "";
  const std::string beside = inScene ? ", or beside the scene file" : "";
  if (std::getenv("RAYPATH") != nullptr) return " in the folders of RAYPATH: " + libraryPath() + beside;
  return " in " + libraryPath() + beside + ": RAYPATH, the folders to look in, is not set";
}

std::string libraryPath() {
  const char* path = std::getenv("RAYPATH");
  return path ? path : ".:/usr/local/lib/ray";
}

std::string joinPath(std::string_view base, std::string_view name) {
  return (std::filesystem::path(base) / name).string();
}

std::string directoryOf(std::string_view path) {
  const size_t slash = path.rfind('/');
  if (slash == path.npos) return {};
  return std::string(path.substr(0, slash == 0 ? 1 : slash));
}

std::optional<std::string> findFile(std::string_view name, std::string_view searchPath, std::string_view base,
                                    const FileAccess& access) {
  if (name.empty() || name.find('\0') != name.npos) return {};
  if (standsAlone(name)) {
    std::optional<std::string> path = name[0] == '~' ? inHome(name) : joinPath(base, name);
    if (path && !(readable(*path) && access.allows(*path))) path.reset();
    return path;
  }
  const std::string folders = std::string(searchPath) + ':';  // as in foldersOf()
  for (std::string_view directory : split(folders, ":")) {
    if (directory == ".") directory = {};  // so that messages say "desk.rad" instead of "./desk.rad"
    std::string path = joinPath(base, joinPath(directory, name));
    std::error_code none;
    if (readable(path) && !std::filesystem::is_directory(path, none) && access.allows(path)) return path;
  }
  return {};
}

}  // namespace rad
