#pragma once
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include "rad_parser/description.h"

namespace rad {

// A file open for reading, until this ends. descriptor() is -1, and errno says why, where it cannot be
// opened.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ >= 0) fstat(descriptor_, &begin_);
  }
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }
  // False for folders, pipes and devices.
  bool isRegular() const { return S_ISREG(begin_.st_mode); }

  // All that it has from where it is read to. Throws Error where that cannot be read, as a folder cannot.
  std::string contents(std::string_view name) const {
    std::string bytes;
    if (S_ISREG(begin_.st_mode)) bytes.reserve(static_cast<size_t>(begin_.st_size));
    char block[1 << 16];
    for (ssize_t got = 1; got != 0;) {
      got = read(descriptor_, block, sizeof block);
      if (got < 0 && errno != EINTR)
        throw Error(printable(name, 4096) + ": cannot read: " + std::strerror(errno), Status::system);
      if (got > 0) bytes.append(block, static_cast<size_t>(got));
    }
    return bytes;
  }

  // Throws Error where somebody has written to the file since it was opened: what was read may be neither
  // what was there nor what is. Changes that leave its length are seen by its time, which some systems keep
  // to 10 ms.
  void requireUnchanged(std::string_view name) const {
    struct stat now {};
    if (!S_ISREG(begin_.st_mode) || fstat(descriptor_, &now) != 0) return;
    if (now.st_size != begin_.st_size || now.st_mtim.tv_sec != begin_.st_mtim.tv_sec ||
        now.st_mtim.tv_nsec != begin_.st_mtim.tv_nsec)
      throw Error(printable(name, 4096) + ": changed while it was read", Status::system);
  }

 private:
  int descriptor_;
  struct stat begin_ {};
};

}  // namespace rad
