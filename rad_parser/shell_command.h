#pragma once
#include <sys/types.h>

#include <string>

namespace rad {

// A command that runs in /bin/sh, in a directory, and whose standard output is read. Its standard input is
// empty (the program's own holds the records to answer), its standard error is the program's. Ended with the
// object: a command that was not finished is killed.
class ShellCommand {
 public:
  // directory: where it runs; empty: the current one. Throws std::system_error where no process can be
  // started.
  ShellCommand(const std::string& command, const std::string& directory);
  ~ShellCommand();
  ShellCommand(const ShellCommand&) = delete;
  ShellCommand& operator=(const ShellCommand&) = delete;

  int output() const { return output_; }

  // Waits for its end, after output() was read. Empty where it ended well, else how it ended ("exit status
  // 127").
  std::string finish();

 private:
  int output_ = -1;
  pid_t process_ = -1;
};

}  // namespace rad
