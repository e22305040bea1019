#pragma once
#include <sys/types.h>

#include <string>

namespace rad {

// A command that runs in /bin/sh, in a given directory, and whose standard output is read. Its standard input
// is empty, because the program's own contains the records to answer. Its standard error is that of the
// program. The destructor kills a command that was not finished.
class ShellCommand {
 public:
  // directory: the directory in which the command runs; empty: the current one. Throws std::system_error if
  // no process can be started.
  ShellCommand(const std::string& command, const std::string& directory);
  ~ShellCommand();
  ShellCommand(const ShellCommand&) = delete;
  ShellCommand& operator=(const ShellCommand&) = delete;

  int output() const { return output_; }

  // Waits until the command ends; call it after reading output(). Returns an empty string if the status is 0,
  // otherwise how the command ended ("exit status 127").
  std::string finish();

 private:
  int output_ = -1;
  pid_t process_ = -1;
};

}  // namespace rad
