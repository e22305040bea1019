#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rsphere {

// A file in memory. It has no name, so that nothing remains if the program is killed.
class MemoryFile {
 public:
  // The file contains `bytes`, and its offset is at their start. Throws rad::Error (Status::system) if it
  // cannot be created.
  explicit MemoryFile(std::string_view bytes = {});
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return fd_; }
  // A path by which this process and its children can open the file.
  std::string path() const;
  std::string contents() const;

 private:
  int fd_;
};

struct ChildResult {
  int status = 0;      // exit status; 128 plus the number of the signal that ended it
  std::string errors;  // the text that it wrote to standard error
  double seconds = 0;  // CPU time, including that of its child processes
};

// Runs the program words[0], a path, with the remaining words as arguments, and waits for its end. The child
// is terminated if this process ends first. The status is 127 if the program cannot be started. Throws
// rad::Error (Status::system) if the process cannot be created.
ChildResult runChild(const std::vector<std::string>& words, const MemoryFile& in, const MemoryFile& out);

}  // namespace rsphere
