#include "rad_parser/shell_command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

extern "C" char** environ;

namespace rad {
namespace {

// Actions of posix_spawn in the child process, in this order.
struct Actions {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  Actions(int output, const std::string& directory) {
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    if (!directory.empty()) posix_spawn_file_actions_addchdir_np(&files, directory.c_str());
    // If this program ignores SIGPIPE, its children would inherit that, and a command whose output is no
    // longer read would continue writing forever.
    sigset_t broken;
    sigemptyset(&broken);
    sigaddset(&broken, SIGPIPE);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &broken);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  }
  ~Actions() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

int wait(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

ShellCommand::ShellCommand(const std::string& command, const std::string& directory) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
  const Actions actions(ends[1], directory);
  std::string shell = "sh", option = "-c", text = command;
  char* arguments[] = {shell.data(), option.data(), text.data(), nullptr};
  const int fault =
      posix_spawn(&process_, "/bin/sh", &actions.files, &actions.attributes, arguments, environ);
  close(ends[1]);
  if (fault != 0) {
    close(ends[0]);
    throw std::system_error(fault, std::generic_category());
  }
  output_ = ends[0];
}

ShellCommand::~ShellCommand() {
  if (process_ < 0) return;
  close(output_);
  kill(process_, SIGKILL);
  wait(process_);
}

std::string ShellCommand::finish() {
  close(output_);
  const int status = wait(process_);
  process_ = -1;
  if (WIFSIGNALED(status)) return fmt::format("signal {}", WTERMSIG(status));
  constexpr int kNotFound = 127;  // sh(1)
  return WEXITSTATUS(status) == 0
             ? ""
             : fmt::format(
                   "exit status {}{}", WEXITSTATUS(status),
                   WEXITSTATUS(status) == kNotFound
                       ? " (command not found; if it is one of RADIANCE's programs, add their folder to PATH)"
                       : "");
}

}  // namespace rad
