#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rad_parser/error.h"

namespace rsphere {

// The other end of the output was closed: nobody wants the rest. Not a fault; no message is due.
class ClosedPipe : public rad::Error {
 public:
  ClosedPipe() : rad::Error("Broken pipe", rad::Status::signal) {}
};

// Collects bytes and hands them to a file descriptor in blocks of 64 KiB, or at flush() only.
class RecordWriter {
 public:
  // The descriptor stays the caller's. What was not flushed is dropped with the writer.
  explicit RecordWriter(int fd) : fd_(fd) {}

  // Whether bytes are kept until flush(), however many: for a program that writes a group of records before
  // it reads the answers, where writing early would block both.
  void holdUntilFlush(bool hold) { hold_ = hold; }

  // Both throw ClosedPipe where nobody reads any more (SIGPIPE must be ignored), rad::Error with
  // Status::system where the system refuses (disk full).
  void write(std::string_view bytes);
  void flush();

  // Where the next byte comes to stand in the file; empty where the output cannot seek.
  std::optional<int64_t> position() const;

 private:
  int fd_;
  bool hold_ = false;
  std::string pending_;
};

}  // namespace rsphere
