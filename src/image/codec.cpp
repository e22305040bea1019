#include "image/codec.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "rad_parser/error.h"

namespace rsphere {
namespace {

const ImageCodec* load() {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto beside = program.parent_path().parent_path() / "lib/rsphere/openimageio.so";
  void* object = dlopen(beside.c_str(), RTLD_LAZY | RTLD_LOCAL);
  const std::string why = object ? "" : dlerror();
  if (!object) object = dlopen("openimageio.so", RTLD_LAZY | RTLD_LOCAL);
  const void* codec = object ? dlsym(object, kImageCodecSymbol) : nullptr;
  if (!codec) throw rad::Error(fmt::format("cannot read or write pictures: {}", why), rad::Status::system);
  return static_cast<const ImageCodec*>(codec);
}

}  // namespace

const ImageCodec& imageCodec() {
  static const ImageCodec* const codec = load();
  return *codec;
}

}  // namespace rsphere
