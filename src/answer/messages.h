#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/error.h"
#include "rad_parser/printable.h"

namespace rsphere {

// The options of messages.
struct MessageOptions {
  bool warnings = true;              // -w
  std::string errorFile;             // -e
  std::vector<std::string> remarks;  // warnings about the command line itself
};

// The only writer of messages. Each message is one write(2) to standard error, or to the file of -e, so that
// the messages of several programs do not mix. If the file cannot be written, as on a full disk, the message
// goes to standard error. A message is one printable line (rad::messageLine()) that begins with the program's
// name, as in rtrace:
//   rsphere: warning - ...    dropped under -w
//   rsphere: fatal - ...      exit status 1
//   rsphere: system - ...     exit status 2
//   rsphere: signal - ...     exit status 3
// May be called from several threads at once.
class Messages {
 public:
  // program: argv[0] without its folder.
  explicit Messages(std::string_view program) : program_(rad::printable(program)) {}
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  // Applies the options from now on, and writes their remarks as warnings. Messages are appended to the file
  // of -e, after a line of asterisks and a line with the process id and `command`, the command line. Throws
  // rad::Error (Status::system) if the file cannot be opened.
  void use(const MessageOptions& options, std::string_view command);

  void warning(std::string_view text) const;

  // Writes why the program stops, and returns its exit status. Writes nothing about a closed output pipe.
  int error(const rad::Error& error) const;

  // Writes a line without a class, for progress reports.
  void report(std::string_view text) const;

  // The file that messages are written to at present, for StopSignals::reportTo().
  int descriptor() const { return fd_; }

 private:
  void write(std::string_view kind, std::string_view text) const;

  std::string program_;
  bool warnings_ = true;
  int fd_ = 2;
};

}  // namespace rsphere
