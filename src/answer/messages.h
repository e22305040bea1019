#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/error.h"

namespace rsphere {

struct MessageOptions {
  bool warnings = true;              // -w
  std::string errorFile;             // -e
  std::vector<std::string> remarks;  // warnings about the command line itself
};

// The one writer of messages. Each is one write(2) to standard error, or to the file of -e, so that those of
// several programs never mix; each line of it begins with the program's name, as rtrace's do:
//   rsphere: warning - ...    dropped under -w
//   rsphere: fatal - ...      exit status 1
//   rsphere: system - ...     exit status 2
//   rsphere: signal - ...     exit status 3
// May be called from several threads at once.
class Messages {
 public:
  // `program` is what lines begin with: argv[0] without its folder.
  explicit Messages(std::string program) : program_(std::move(program)) {}
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  // Applies the options from now on, and writes their remarks as warnings. Messages are appended to the file
  // of -e, after a line of asterisks and a line with the process id and `command`, the command line. Throws
  // rad::Error (Status::system) if the file cannot be opened.
  void use(const MessageOptions& options, std::string_view command);

  void warning(std::string_view text) const;

  // Says why the program stops, and returns its exit status. A closed output pipe is not worth a word.
  int error(const rad::Error& error) const;

  // One line without a class, for progress reports.
  void report(std::string_view text) const;

  // Where messages go now: for StopSignals::reportTo().
  int descriptor() const { return fd_; }

 private:
  void write(std::string_view kind, std::string_view text) const;

  std::string program_;
  bool warnings_ = true;
  int fd_ = 2;
};

}  // namespace rsphere
