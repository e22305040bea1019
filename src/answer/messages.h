#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/error.h"
#include "rad_parser/printable.h"

namespace rsphere {

struct MessageOptions {
  bool warnings = true;              // -w
  std::string errorFile;             // -e
  std::vector<std::string> remarks;  // warnings about the command line itself
};

// Writes all messages of the program. Each message is one write(2) to standard error or to the file of -e, so
// that messages of several programs do not mix. If the file cannot be written, for example on a full disk,
// the message goes to standard error. A message is one printable line (rad::messageLine()) that begins with
// the program's name, as in rtrace:
//   rsphere: warning - ...    suppressed by -w
//   rsphere: fatal - ...      exit status 1
//   rsphere: system - ...     exit status 2
//   rsphere: signal - ...     exit status 3
// Thread-safe.
class Messages {
 public:
  // program: argv[0] without its folder.
  explicit Messages(std::string_view program) : program_(rad::printable(program)) {}
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  // Applies the options to all following messages, and writes their remarks as warnings. If a file is given
  // with -e, messages are appended to it, after a line of asterisks and a line with the process id and
  // `command`, the command line. Throws rad::Error (Status::system) if the file cannot be opened.
  void use(const MessageOptions& options, std::string_view command);

  void warning(std::string_view text) const;

  // Writes the reason why the program stops, and returns its exit status. Writes nothing for a closed output
  // pipe.
  int error(const rad::Error& error) const;

  // Writes a line without a class such as "warning", for progress reports.
  void report(std::string_view text) const;

  // The descriptor of the file to which messages are written, for StopSignals::reportTo().
  int descriptor() const { return fd_; }

 private:
  void write(std::string_view kind, std::string_view text) const;

  std::string program_;
  bool warnings_ = true;
  int fd_ = 2;
};

}  // namespace rsphere
