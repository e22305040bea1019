#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "rad_parser/error.h"

namespace rsphere {

// Thrown if the reader of the output has closed its end. This is not an error, and no message is written.
class ClosedPipe : public rad::Error {
 public:
  ClosedPipe() : rad::Error("Broken pipe", rad::Status::signal) {}
};

// Destination of the answers of a run, in the order of the records.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  // Receives the answers to any number of whole records.
  virtual void write(std::string_view bytes) = 0;
  // Delivers all bytes written before.
  virtual void flush() = 0;
  // Keeps all bytes until flush(), regardless of their number. Used if a program writes a group of records
  // before it reads the answers: an earlier write would block both programs.
  virtual void holdUntilFlush(bool hold) = 0;
};

// Collects bytes and writes them to a file descriptor in blocks of 64 KiB, or only at flush().
class RecordWriter final : public RecordSink {
 public:
  // The caller keeps the descriptor open, and later closes it. The destructor discards bytes that were not
  // flushed. name: of the file, for messages; empty: standard output.
  explicit RecordWriter(int fd, std::string name = {}) : fd_(fd), name_(std::move(name)) {}

  void holdUntilFlush(bool hold) override { hold_ = hold; }

  // Both throw ClosedPipe if the reader has closed its end (SIGPIPE must be ignored), and rad::Error with
  // Status::system for any other error of write(2), such as a full disk.
  void write(std::string_view bytes) override;
  void flush() override;

  // The offset of the next byte in the file; empty if the output is not seekable.
  std::optional<int64_t> position() const;

 private:
  int fd_;
  std::string name_;
  bool hold_ = false;
  std::string pending_;
};

}  // namespace rsphere
