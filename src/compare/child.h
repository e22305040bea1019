#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rsphere {

// A file in memory, without a name: nothing stays behind, however the program ends.
class MemoryFile {
 public:
  // Throws rad::Error (Status::system) where the system has none. Begins with `bytes`, read from their start.
  explicit MemoryFile(std::string_view bytes = {});
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return fd_; }
  // A path by which this process and its children can open it.
  std::string path() const;
  std::string contents() const;

 private:
  int fd_;
};

struct ChildResult {
  int status = 0;      // exit status; 128 and the signal's number where one ended it
  std::string errors;  // what it wrote to standard error
  double seconds = 0;  // CPU time, with that of its own children
};

// Runs words[0], a path, and waits for it. It ends when this process does; status 127 where it cannot be
// started. Throws rad::Error (Status::system) where there can be no process.
ChildResult runChild(const std::vector<std::string>& words, const MemoryFile& in, const MemoryFile& out);

}  // namespace rsphere
