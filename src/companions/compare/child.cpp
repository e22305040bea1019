#include "companions/compare/child.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "rad_parser/error.h"
#include "rad_parser/open_file.h"

namespace rsphere {
namespace {

[[noreturn]] void systemError(std::string_view what) {
  throw rad::Error(fmt::format("{}: {}", what, std::strerror(errno)), rad::Status::system);
}

double secondsOf(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

// Called in the child process. Returns only if the program cannot be started.
void becomeProgram(char* const* words, int in, int out, int errors) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  std::signal(SIGPIPE, SIG_DFL);
  if (dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(errors, 2) < 0) return;
  execv(words[0], words);
}

}  // namespace

MemoryFile::MemoryFile(std::string_view bytes) : fd_(memfd_create("rsphere", MFD_CLOEXEC)) {
  if (fd_ < 0) systemError("cannot create a file in memory");
  if (!rad::writeAll(fd_, bytes)) {
    const int error = errno;
    close(fd_);
    errno = error;
    systemError("cannot write to a file in memory");
  }
  lseek(fd_, 0, SEEK_SET);
}

MemoryFile::~MemoryFile() { close(fd_); }

std::string MemoryFile::path() const { return fmt::format("/proc/{}/fd/{}", getpid(), fd_); }

std::string MemoryFile::contents() const { return rad::OpenFile(path()).contents("file in memory"); }

ChildResult runChild(const std::vector<std::string>& words, const MemoryFile& in, const MemoryFile& out) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const MemoryFile errors;
  const pid_t child = fork();
  if (child < 0) systemError(fmt::format("cannot start {}", words[0]));
  if (child == 0) {
    becomeProgram(pointers.data(), in.descriptor(), out.descriptor(), errors.descriptor());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) systemError(fmt::format("cannot wait for {}", words[0]));
  ChildResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.errors = errors.contents();
  result.seconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
  return result;
}

}  // namespace rsphere
