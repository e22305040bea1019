#include "records/record_writer.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "rad_parser/printable.h"

namespace rsphere {
namespace {

constexpr size_t kPipeCapacity = 65536;  // on Linux

}  // namespace

void RecordWriter::write(std::string_view bytes) {
  pending_ += bytes;
  if (!hold_ && pending_.size() >= kPipeCapacity) flush();
}

void RecordWriter::flush() {
  size_t done = 0;
  while (done < pending_.size()) {
    const ssize_t n = ::write(fd_, pending_.data() + done, pending_.size() - done);
    if (n >= 0) {
      done += static_cast<size_t>(n);
      continue;
    }
    if (errno == EINTR) continue;
    if (errno == EAGAIN) {
      pollfd ready{fd_, POLLOUT, 0};
      poll(&ready, 1, -1);
      continue;
    }
    const bool closed = errno == EPIPE;
    const std::string text = fmt::format("{}{}write error: {}", rad::printableName(name_),
                                         name_.empty() ? "" : ": ", std::strerror(errno));
    pending_.clear();  // a second attempt would write some bytes twice
    if (closed) throw ClosedPipe();
    throw rad::Error(text, rad::Status::system);
  }
  pending_.clear();
}

std::optional<int64_t> RecordWriter::position() const {
  const off_t at = lseek(fd_, 0, SEEK_CUR);
  if (at < 0) return std::nullopt;
  return static_cast<int64_t>(at) + static_cast<int64_t>(pending_.size());
}

}  // namespace rsphere
