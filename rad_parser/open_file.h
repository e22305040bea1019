#pragma once
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <string_view>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "rad_parser/printable.h"

namespace rad {

// A file that is open for reading as long as this object exists. If it cannot be opened, descriptor() is -1
// and errno is the reason.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
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
  // Size in bytes when the file was opened, if it is regular.
  size_t size() const { return static_cast<size_t>(begin_.st_size); }

  // The contents, starting at the current position. name: for messages. Throws Error if they cannot be read,
  // for example if it is a folder, or, called at once, if the file could not be opened.
  std::string contents(std::string_view name) const {
    std::string bytes;
    if (S_ISREG(begin_.st_mode)) bytes.reserve(static_cast<size_t>(begin_.st_size));
    char block[1 << 16];
    for (ssize_t got = 1; got != 0;) {
      got = descriptor_ < 0 ? -1 : read(descriptor_, block, sizeof block);
      if (got < 0 && errno != EINTR) throw systemError(printable(name, kLongestName) + ": cannot read");
      if (got > 0) bytes.append(block, static_cast<size_t>(got));
    }
    return bytes;
  }

  // Throws Error if the file was modified after it was opened, because the data may then be a mixture of old
  // and new contents. If the size has not changed, a modification is detected by the modification time, which
  // some systems only record to 10 ms.
  void requireUnchanged(std::string_view name) const {
    struct stat now {};
    if (!S_ISREG(begin_.st_mode) || fstat(descriptor_, &now) != 0) return;
    if (now.st_size != begin_.st_size || now.st_mtim.tv_sec != begin_.st_mtim.tv_sec ||
        now.st_mtim.tv_nsec != begin_.st_mtim.tv_nsec)
      throw Error(printable(name, kLongestName) + ": changed while it was read", Status::system);
  }

 private:
  int descriptor_;
  struct stat begin_ {};
};

// Writes all bytes. Returns false, with errno, if that fails.
inline bool writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(n));
  }
  return true;
}

}  // namespace rad
