#pragma once
// What is interpolated from, kept from one run to the next (-af FILE) in FILE.rsphere. FILE itself is left to
// RADIANCE's programs, which keep light of another kind in it: they stop at a file of this format, and a
// pipeline may name one FILE for both.
//
// A file is three lines that say of which scene and options it is, an empty one, and records of one size,
// each with a checksum. Any number of processes may add to it at once, each under a lock for as long as it
// writes. What a process that was killed has left of a record is cut off by the next that writes, and looked
// past by all that read.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/error.h"

namespace rsphere {

class AmbientFile {
 public:
  using Record = std::array<std::byte, 212>;

  // Makes the file where there is none, or nothing in it. Null, after a warning, where it is not one of ours
  // for this scene and these options, and is left as it is; null, too, where it is no regular file
  // (/dev/null). Throws rad::Error (system) where it cannot be opened or made.
  static std::unique_ptr<AmbientFile> open(const std::string& name, uint64_t scene, uint64_t options,
                                           const rad::Warn& warn);

  // open() of the file that goes with a FILE of -af, which is neither opened nor made. Null where FILE is no
  // regular file (/dev/null), and, after a warning, where FILE is there but the file beside it cannot be
  // opened: FILE may be kept where nobody may write. Throws rad::Error (system) where FILE is a folder, or
  // neither it is there nor can the file beside it be opened.
  static std::unique_ptr<AmbientFile> openBeside(const std::string& given, uint64_t scene, uint64_t options,
                                                 const rad::Warn& warn);
  AmbientFile(const AmbientFile&) = delete;
  AmbientFile& operator=(const AmbientFile&) = delete;
  ~AmbientFile();

  // All that was there when it was opened; some may be there twice. Hands them over.
  std::vector<Record> take() { return std::move(records_); }

  // Adds records to the file. False where another process has it locked and wait is not set. Warns once where
  // it cannot be written to, and does nothing from then on.
  bool add(std::span<const Record> records, bool wait);

 private:
  AmbientFile(std::string name, int descriptor, bool writable, rad::Warn warn);
  bool begin(uint64_t scene, uint64_t options);
  void read();

  std::string name_;
  int descriptor_;
  bool writable_;
  rad::Warn warn_;
  std::vector<Record> records_;
};

}  // namespace rsphere
