#pragma once
#include <sys/types.h>

#include <string>

namespace rad {

// A command that runs in /bin/sh in a given directory, and whose standard output is read. Its standard input
// is empty, because that of this program contains the records to be answered. It shares this program's
// standard error. The destructor kills an unfinished command.
class ShellCommand {
 public:
  // directory: in which the command runs; empty: the current one. Throws std::system_error if no process can
  // be started.
  ShellCommand(const std::string& command, const std::string& directory);
  ~ShellCommand();
  ShellCommand(const ShellCommand&) = delete;
  ShellCommand& operator=(const ShellCommand&) = delete;

  int output() const { return output_; }

  // Waits until the command ends. REQUIRES that output() was read to its end. Returns an empty string if the
  // status is 0, otherwise the way in which the command ended ("exit status 127").
  std::string finish();

 private:
  int output_ = -1;
  pid_t process_ = -1;
};

}  // namespace rad
