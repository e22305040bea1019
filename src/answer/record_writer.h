#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rad_parser/error.h"

namespace rsphere {

// Thrown when the reader of the output has closed its end. This is not a fault, and no message is written.
class ClosedPipe : public rad::Error {
 public:
  ClosedPipe() : rad::Error("Broken pipe", rad::Status::signal) {}
};

// Where the answers of a run go, in the order of the records.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  // Gets the answers to any number of records, whole.
  virtual void write(std::string_view bytes) = 0;
  // What was given before must arrive.
  virtual void flush() = 0;
  // Keeps all bytes until flush(), regardless of their number. This is for a program that writes a group of
  // records before it reads the answers: earlier writes would block both programs.
  virtual void holdUntilFlush(bool hold) = 0;
};

// Collects bytes and writes them to a file descriptor in blocks of 64 KiB, or only at flush().
class RecordWriter final : public RecordSink {
 public:
  // The caller keeps the descriptor open, and closes it. The destructor discards bytes that were not flushed.
  explicit RecordWriter(int fd) : fd_(fd) {}

  void holdUntilFlush(bool hold) override { hold_ = hold; }

  // Both throw ClosedPipe if the reader has closed its end (SIGPIPE must be ignored), and rad::Error with
  // Status::system if write(2) fails otherwise, as on a full disk.
  void write(std::string_view bytes) override;
  void flush() override;

  // The offset of the next byte in the file; empty if the output cannot seek.
  std::optional<int64_t> position() const;

 private:
  int fd_;
  bool hold_ = false;
  std::string pending_;
};

}  // namespace rsphere
