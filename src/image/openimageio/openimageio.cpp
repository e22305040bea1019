#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "image/codec.h"

namespace rsphere {
namespace {

// OpenImageIO starts no threads, because -n limits their number, and pictures are small.
[[maybe_unused]] const bool kOneThread = OIIO::attribute("threads", 1);

std::string formatOf(const std::string& name, std::string& format) {
  const auto output = OIIO::ImageOutput::create(name);
  if (!output) return OIIO::geterror();
  format = output->format_name();
  return "";
}

// A file in memory, for formats whose writers need the name of a file: SGI, FITS and others.
class MemoryFile {
 public:
  MemoryFile() : fd_(memfd_create("picture", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (fd_ >= 0) close(fd_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }
  // False if it cannot be read.
  bool contents(std::string& bytes) const {
    std::ifstream file(path(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
    return file.good() || file.eof();
  }

 private:
  int fd_;
};

std::string encode(const std::string& name, int width, int height, bool radiance, const float* pixels,
                   std::string& bytes) {
  const auto output = OIIO::ImageOutput::create(name);
  if (!output) return OIIO::geterror();
  OIIO::ImageSpec spec(width, height, 3, radiance ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", radiance ? "Linear" : "sRGB");
  // PFM begins with the lowest row. OpenImageIO 2.5 writes the rows of PPM in that order too unless told
  // not to.
  spec.attribute("pnm:pfmflip", radiance ? 1 : 0);
  const auto write = [&](const std::string& path) {
    return output->open(path, spec) && output->write_image(OIIO::TypeDesc::FLOAT, pixels) && output->close();
  };
  if (output->supports("ioproxy")) {
    std::vector<unsigned char> buffer;
    OIIO::Filesystem::IOVecOutput proxy(buffer);
    output->set_ioproxy(&proxy);
    if (!write(name)) return output->geterror();
    bytes.assign(buffer.begin(), buffer.end());
    return "";
  }
  const MemoryFile file;
  if (!write(file.path())) return output->geterror();
  return file.contents(bytes) ? "" : std::strerror(errno);
}

}  // namespace

extern "C" {
__attribute__((visibility("default"))) extern const ImageCodec rsphereImageCodec;
const ImageCodec rsphereImageCodec{formatOf, encode};

// encode() for Python: hands the contents of the file to `take`, or an error.
__attribute__((visibility("default"))) void rsphereEncode(const char* name, int width, int height,
                                                          int radiance, const float* pixels,
                                                          void (*take)(const char*, size_t, const char*)) {
  std::string bytes;
  const std::string error = encode(name, width, height, radiance != 0, pixels, bytes);
  take(bytes.data(), bytes.size(), error.empty() ? nullptr : error.c_str());
}
}

}  // namespace rsphere
