#include "image/codec.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace rsphere {
namespace {

// The folders that may contain the shared object.
std::vector<std::filesystem::path> folders() {
  std::vector<std::filesystem::path> found;
  // For librsphere.so, it is the folder rsphere next to the library or, if the library's folder is named
  // after the machine as on Debian, next to that folder.
  Dl_info info;
  link_map* object = nullptr;
  const bool known = dladdr1(reinterpret_cast<const void*>(&imageCodec), &info,
                             reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) != 0;
  if (known && object && object->l_name[0] != '\0') {  // an empty name is that of the program itself
    const std::filesystem::path beside = std::filesystem::path(object->l_name).parent_path();
    found.push_back(beside / "rsphere");
    found.push_back(beside.parent_path() / "rsphere");
  }
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  found.push_back(program.parent_path().parent_path() / "lib/rsphere");
  return found;
}

bool loaded = false;

const ImageCodec* load() {
  void* object = nullptr;
  for (const auto& folder : folders())
    if (!object) object = dlopen((folder / "openimageio.so").c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (!object) object = dlopen("openimageio.so", RTLD_LAZY | RTLD_LOCAL);
  loaded = object != nullptr;
  return object ? static_cast<const ImageCodec*>(dlsym(object, kImageCodecSymbol)) : nullptr;
}

}  // namespace

const ImageCodec* imageCodec() {
  static const ImageCodec* const codec = load();
  return codec;
}

}  // namespace rsphere

#ifdef __SANITIZE_ADDRESS__
// Called by the leak sanitizer at the end of the program. GCC 12's may crash in a program that has loaded
// OpenImageIO.
extern "C" [[gnu::visibility("default")]] int __lsan_is_turned_off() { return rsphere::loaded; }
#endif
