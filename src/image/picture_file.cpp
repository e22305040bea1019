#include "image/picture_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "image/codec.h"
#include "image/radiance_picture.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

[[noreturn]] void cannotWrite(const std::string& name, std::string why) {
  std::replace(why.begin(), why.end(), '\n', ' ');
  throw rad::Error(fmt::format("cannot write picture \"{}\": {}", name, why), rad::Status::system);
}

}  // namespace

PictureFormat pictureFormat(const std::string& name) {
  for (const std::string_view suffix : {".hdr", ".pic", ".rgbe"})
    if (name.ends_with(suffix)) return PictureFormat::radiance;
  std::string format;
  if (const std::string why = imageCodec().formatOf(name, format); !why.empty()) cannotWrite(name, why);
  return format == "hdr"                           ? PictureFormat::radiance
         : format == "openexr" || format == "tiff" ? PictureFormat::linear
                                                   : PictureFormat::screen;
}

PictureFile::PictureFile(std::string name) : name_(std::move(name)), format_(pictureFormat(name_)) {
  fd_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd_ < 0) fail(std::strerror(errno));
}

PictureFile::~PictureFile() {
  if (fd_ >= 0) close(fd_);
}

void PictureFile::fail(const std::string& why) {
  // Some readers would take a truncated picture for a complete one, so the file is emptied. Devices cannot be
  // emptied; that error is ignored.
  if (fd_ >= 0 && ftruncate(fd_, 0) != 0) errno = 0;
  cannotWrite(name_, why);
}

void PictureFile::write(const Raster& raster, std::string_view header) {
  std::string bytes;
  if (format_ == PictureFormat::radiance) {
    bytes = radiancePicture(raster, header);
  } else {
    const std::string why = imageCodec().encode(
        name_, raster.width, raster.height, format_ == PictureFormat::linear, raster.pixels.data(), bytes);
    if (!why.empty()) fail(why);
  }
  for (std::string_view left = bytes; !left.empty();) {
    const ssize_t n = ::write(fd_, left.data(), left.size());
    if (n < 0 && errno != EINTR) fail(std::strerror(errno));
    if (n > 0) left.remove_prefix(static_cast<size_t>(n));
  }
  const int closed = close(fd_);
  fd_ = -1;
  if (closed != 0 && errno != EINTR) cannotWrite(name_, std::strerror(errno));
}

}  // namespace rsphere
