#include "image/picture_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "image/codec.h"
#include "rad_parser/error.h"
#include "rad_parser/open_file.h"

namespace rsphere {
namespace {

constexpr std::string_view kPng = ".png";

[[noreturn]] void cannotWrite(const std::string& name, std::string why) {
  std::ranges::replace(why, '\n', ' ');
  throw rad::Error(fmt::format("cannot write picture \"{}\": {}", name, why), rad::Status::system);
}

// A new file with a unique name in the folder of a target file. The destructor removes it, unless it has
// replaced the target.
class NewFile {
 public:
  explicit NewFile(std::string target) : target_(std::move(target)) {
    const std::string folder = target_.substr(0, target_.rfind('/') + 1);
    for (int i = 0; i < kMostNames && fd_ < 0; ++i) {
      name_ = fmt::format("{}.rsphere-{}-{}", folder, getpid(), i);
      fd_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (fd_ < 0 && errno != EEXIST) break;
    }
    created_ = fd_ >= 0;
    struct stat before {};
    if (created_ && stat(target_.c_str(), &before) == 0 && fchmod(fd_, before.st_mode & 0777) != 0) errno = 0;
  }
  ~NewFile() {
    if (fd_ >= 0) close(fd_);
    if (created_ && !replaced_) unlink(name_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  // Negative, with errno, if the file cannot be created.
  int descriptor() const { return fd_; }

  // Returns false, with errno, if that fails.
  bool replaceTarget() {
    const int closed = close(std::exchange(fd_, -1));
    if (closed != 0 && errno != EINTR) return false;
    replaced_ = rename(name_.c_str(), target_.c_str()) == 0;
    return replaced_;
  }

 private:
  // Cap on the names that are tried for the temporary file. Few are taken, because each thread writes one
  // picture at a time.
  static constexpr int kMostNames = 10000;

  std::string target_, name_;
  int fd_ = -1;
  bool created_ = false, replaced_ = false;
};

bool isStandardDescriptor(const struct stat& file) {
  for (int fd = 0; fd <= 2; ++fd) {
    struct stat status {};
    if (fstat(fd, &status) == 0 && status.st_dev == file.st_dev && status.st_ino == file.st_ino) return true;
  }
  return false;
}

}  // namespace

PictureFormat pictureFormat(const std::string& name) {
  for (const std::string_view suffix : {".hdr", ".pic", ".rgbe"})
    if (name.ends_with(suffix)) return PictureFormat::radiance;
  if (name.ends_with(kPng)) return PictureFormat::screen;
  std::string format;
  const ImageCodec* const codec = imageCodec();
  if (!codec)
    cannotWrite(
        name,
        "only .hdr and .png are written without OpenImageIO, which is missing; on Debian: apt install "
        "rsphere-pictures");
  if (!codec->formatOf(name, format).empty())
    cannotWrite(name,
                "its suffix is that of no picture format; usual ones are .hdr, .exr, .tif, .png and .jpg");
  if (format == "hdr") return PictureFormat::radiance;
  const bool linear = format == "openexr" || format == "tiff" || name.ends_with(".pfm");
  return linear ? PictureFormat::linear : PictureFormat::screen;
}

PictureFile::PictureFile(std::string name) : name_(std::move(name)), format_(pictureFormat(name_)) {
  struct stat status {};
  const bool exists = stat(name_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) cannotWrite(name_, std::strerror(EISDIR));
  if (exists && access(name_.c_str(), W_OK) != 0) cannotWrite(name_, std::strerror(errno));
  if (exists && (!S_ISREG(status.st_mode) || isStandardDescriptor(status))) return;
  std::error_code none;
  std::string target = std::filesystem::canonical(name_, none).string();
  if (none) target = name_;
  const NewFile trial(target);
  if (trial.descriptor() >= 0)
    target_ = target;
  else if (!exists)
    cannotWrite(name_, std::strerror(errno));
}

void PictureFile::write(const Raster& raster, std::string_view header) {
  std::string bytes;
  if (format_ == PictureFormat::radiance) {
    bytes = radiancePicture(raster, header);
  } else if (name_.ends_with(kPng)) {
    bytes = pngPicture(raster);
  } else {
    const std::string why = imageCodec()->encode(
        name_, raster.width, raster.height, format_ == PictureFormat::linear, raster.pixels.data(), bytes);
    if (!why.empty()) cannotWrite(name_, why);
  }
  if (!target_.empty()) {
    NewFile file(target_);
    if (!rad::writeAll(file.descriptor(), bytes) || !file.replaceTarget())
      cannotWrite(name_, std::strerror(errno));
    return;
  }
  const int fd = open(name_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  const bool written = rad::writeAll(fd, bytes);
  const int why = errno;
  // The file is emptied, because some readers would accept an incomplete picture. Emptying fails for devices,
  // where it is not needed.
  if (fd >= 0 && !written) [[maybe_unused]]
    const int emptied = ftruncate(fd, 0);
  if (fd >= 0) close(fd);
  if (!written) cannotWrite(name_, std::strerror(why));
}

}  // namespace rsphere
