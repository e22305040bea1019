#pragma once
// The sites of the irradiance cache, kept from one run to the next (-af FILE) in FILE.rsphere. FILE itself is
// left to RADIANCE's programs, which keep another kind of records in it and would stop at a file of this
// format. A pipeline may therefore name one FILE for both.
//
// A file consists of three lines that identify the format, the scene and the options, an empty line, and
// records of equal size, each with a checksum. Any number of processes may append to it at once; each holds a
// lock while it writes. If a process is killed while it writes, the next writer overwrites its incomplete
// record, and readers skip it.
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

  // Creates the file, or writes its header if it is empty. Returns null after a warning, and leaves the
  // file as it is, if it is not an ambient file of ours for this scene and these options. Returns null
  // without a warning if it is no regular file (/dev/null). Throws rad::Error (system) if it cannot be
  // opened or created.
  static std::unique_ptr<AmbientFile> open(const std::string& name, uint64_t scene, uint64_t options,
                                           const rad::Warn& warn);

  // Like open(), for the file that belongs to a FILE given by -af. FILE itself is neither opened nor created.
  // Returns null if FILE is no regular file (/dev/null), and, after a warning, if FILE exists but the file
  // beside it cannot be opened, because FILE may be in a folder that is not writable. Throws rad::Error
  // (system) if FILE is a folder, or if FILE does not exist and the file beside it cannot be opened.
  static std::unique_ptr<AmbientFile> openBeside(const std::string& given, uint64_t scene, uint64_t options,
                                                 const rad::Warn& warn);
  AmbientFile(const AmbientFile&) = delete;
  AmbientFile& operator=(const AmbientFile&) = delete;
  ~AmbientFile();

  // The records that the file had when it was opened, some possibly twice. Moves them out.
  std::vector<Record> take() { return std::move(records_); }

  // Appends records to the file. False if another process holds the lock and wait is false. If the file
  // cannot be written, warns once and does nothing from then on.
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
