#include "answer/messages.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <limits>

#include "rad_parser/open_file.h"
#include "records/record_writer.h"

namespace rsphere {
namespace {

constexpr int kStandardError = 2;

}  // namespace

Messages::~Messages() {
  if (fd_ != kStandardError) close(fd_);
}

void Messages::use(const MessageOptions& options, std::string_view command) {
  warnings_ = options.warnings;
  if (!options.errorFile.empty()) {
    const int fd = open(options.errorFile.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd < 0) throw rad::systemError(fmt::format("cannot open error file \"{}\"", options.errorFile));
    if (fd_ != kStandardError) close(fd_);
    fd_ = fd;
    rad::writeAll(fd_, fmt::format("**************\n*** PID {:5}: {}\n\n", getpid(),
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
  constexpr std::array<std::string_view, 4> kKinds = {"", "fatal - ", "system - ", "signal - "};
  write(kKinds[static_cast<size_t>(status)], error.what());
  return status;
}

void Messages::report(std::string_view text) const { write("", text); }

void Messages::write(std::string_view kind, std::string_view text) const {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  const std::string line = fmt::format("{}: {}{}\n", program_, kind, rad::messageLine(text));
  if (!rad::writeAll(fd_, line) && fd_ != kStandardError) rad::writeAll(kStandardError, line);
}

}  // namespace rsphere
