#include "answer/messages.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "records/record_writer.h"

namespace rsphere {
namespace {

constexpr int kStandardError = 2;

// Returns whether all of the text was written.
bool writeAll(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    text.remove_prefix(static_cast<size_t>(n));
  }
  return true;
}

}  // namespace

Messages::~Messages() {
  if (fd_ != kStandardError) close(fd_);
}

void Messages::use(const MessageOptions& options, std::string_view command) {
  warnings_ = options.warnings;
  if (!options.errorFile.empty()) {
    const int fd = open(options.errorFile.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd < 0)
      throw rad::Error(
          fmt::format("cannot open error file \"{}\": {}", options.errorFile, std::strerror(errno)),
          rad::Status::system);
    if (fd_ != kStandardError) close(fd_);
    fd_ = fd;
    writeAll(fd_, fmt::format("**************\n*** PID {:5}: {}\n\n", getpid(),
                              rad::printable(command, std::numeric_limits<size_t>::max())));
  }
  for (const std::string& remark : options.remarks) warning(remark);
}

void Messages::warning(std::string_view text) const {
  if (warnings_) write("warning - ", text);
}

int Messages::error(const rad::Error& error) const {
  const int status = static_cast<int>(error.status());
  if (dynamic_cast<const ClosedPipe*>(&error) != nullptr) return status;
  switch (error.status()) {
    case rad::Status::input: write("fatal - ", error.what()); break;
    case rad::Status::system: write("system - ", error.what()); break;
    case rad::Status::signal: write("signal - ", error.what()); break;
  }
  return status;
}

void Messages::report(std::string_view text) const { write("", text); }

void Messages::write(std::string_view kind, std::string_view text) const {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  const std::string line = fmt::format("{}: {}{}\n", program_, kind, rad::messageLine(text));
  if (!writeAll(fd_, line) && fd_ != kStandardError) writeAll(kStandardError, line);
}

}  // namespace rsphere
