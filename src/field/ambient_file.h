#pragma once
// Keeps the sites of the irradiance cache from one run to the next (-af FILE) in FILE.rsphere. FILE itself is
// left to RADIANCE's programs, whose records differ and which would reject this format. One -af FILE can
// therefore be given to programs of both kinds.
//
// The file consists of three lines that identify the format, the scene and the options, an empty line, and
// records of equal size, each with a checksum. Several processes may append to it at the same time; each
// locks the file while it writes. If a process is killed while writing, readers skip its incomplete record,
// and the next writer overwrites it.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rad_parser/error.h"

namespace rsphere {

class AmbientFile {
 public:
  using Record = std::array<std::byte, 212>;

  // Creates the file, or writes the header if the file is empty. Returns null after a warning if the file is
  // not an ambient file of rsphere for this scene and these options; such a file is not changed. Returns null
  // without a warning if it is not a regular file (/dev/null). Throws rad::Error (system) if it cannot be
  // opened or created.
  static std::unique_ptr<AmbientFile> open(const std::string& name, uint64_t scene, uint64_t options,
                                           const rad::Warn& warn);

  // Like open(), for the file FILE.rsphere where -af gives FILE. FILE itself is neither opened nor created.
  // Returns null if FILE is not a regular file (/dev/null). If FILE.rsphere cannot be opened, returns null
  // after a warning if FILE exists, because its folder may not be writable, and otherwise throws rad::Error
  // (system). Throws rad::Error (system) if FILE is a folder.
  static std::unique_ptr<AmbientFile> openBeside(const std::string& given, uint64_t scene, uint64_t options,
                                                 const rad::Warn& warn);
  AmbientFile(const AmbientFile&) = delete;
  AmbientFile& operator=(const AmbientFile&) = delete;
  ~AmbientFile();

  // Moves out the records that the file contained when it was opened. Some may occur twice.
  std::vector<Record> take() { return std::move(records_); }

  // Appends records to the file. Returns false if another process holds the lock and `wait` is false. If the
  // file cannot be written, warns once and writes nothing from then on.
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
