#include "rad_parser/file_beside.h"

#include <filesystem>
#include <system_error>

namespace rad {

std::optional<std::string> fileBeside(const Description& description, Place place, std::string_view name,
                                      const FileAccess& access) {
  if (name.empty() || name[0] == '/' || name[0] == '~') return {};
  const SourceFile* file = &description.files[place.file];
  while (file->name.starts_with('!')) {
    if (file->from.file == SourceFile::kNoFile) return {};
    file = &description.files[file->from.file];
  }
  const std::string folder = directoryOf(file->name);
  const bool standsAlone = folder.starts_with('/') || folder.starts_with('.');
  auto path = findFile(joinPath(standsAlone ? folder : "./" + folder, name), {}, {}, access);
  std::error_code none;
  if (path && std::filesystem::is_directory(*path, none)) path.reset();
  return path;
}

std::string nameOfFile(const Description& description, Place place, std::string_view name,
                       const FileAccess& access) {
  if (findFile(name, libraryPath(), {}, access)) return std::string(name);
  return fileBeside(description, place, name, access).value_or(std::string(name));
}

}  // namespace rad
