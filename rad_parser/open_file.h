#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <string>

namespace rad {

// A file open for reading, until this ends. descriptor() is -1, and errno says why, where it cannot be
// opened.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace rad
