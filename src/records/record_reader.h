#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/number_text.h"

namespace rsphere {

// The meaning of line ends in text records. They are blanks, as in rtrace, or they end records: each line
// that is not blank is then one record, and a line with too many or too few columns is reported instead of
// shifting all later numbers.
enum class LineEnds : uint8_t { areBlanks, endRecords };

// Reads records of numbers from a file descriptor: text (numbers between white space, which may be quoted) or
// native floats or doubles. It waits for input only if no complete record has arrived, and only for the next
// record, so that a program may write one record and wait for the answer. Stores one block of input (64 KiB).
// Not thread-safe.
class RecordReader {
 public:
  static constexpr int kMostNumbers = 6;

  // REQUIRES: format is ascii, float32 or float64; 1 <= numbersPerRecord <= 6. `name` begins the messages.
  // The caller keeps the descriptor open, and later closes it.
  RecordReader(int fd, NumberFormat format, int numbersPerRecord, LineEnds lineEnds = LineEnds::areBlanks,
               std::string name = "stdin");

  // Waits for the next record and appends its numbers, and those of further records that have arrived, up to
  // `most` records. Returns the number of records; 0 at the end of input or if interrupted. Throws rad::Error
  // if the next record is malformed or incomplete, after all preceding records were returned: 'stdin:3:
  // expected 6 numbers, got "x"'. For binary input, 3 is the number of the record, from 1. The following are
  // malformed:
  // - words that RADIANCE does not read as numbers (nan, inf, 0x10, "1,5", "#") or that a double cannot hold;
  // - lines with fewer or more numbers, or longer than 64 KiB, if line ends are the ends of records;
  // - binary numbers that are not finite.
  // Throws rad::Error with Status::system if read(2) fails.
  size_t read(std::vector<double>& numbers, size_t most);

  // Waits for the next record. Returns the number of records that have arrived, at most `most`, which the
  // next read() will return.
  size_t arrived(size_t most);

  // `waiting` is called with true before the reader waits for input, and with false when it stops waiting.
  void whenWaiting(std::function<void(bool)> waiting) { waiting_ = std::move(waiting); }

  // If one of these descriptors becomes readable, waiting ends, and all further calls of read() return 0.
  void interruptBy(std::vector<int> fds) { wakeFds_ = std::move(fds); }

  // Number of records returned.
  uint64_t records() const { return records_; }

  // The fraction of a regular file that has been returned, 0 to 1; 0 for other input.
  double shareRead() const;

  // The first line of text that is not blank, after it has been read to its end. The number of values in it
  // shows whether records have the expected columns. Empty for binary input, and if line ends are the ends of
  // records.
  struct FirstLine {
    uint64_t line = 1;
    int numbers = 0;
  };
  const std::optional<FirstLine>& firstLine() const { return firstLine_; }

  // Whether the first record of binary input, once it was read, consists of printable characters only. Text
  // does, but hardly any floats or doubles do.
  bool firstRecordIsText() const { return firstIsText_; }

 private:
  size_t readText(std::vector<double>& numbers, size_t most);
  size_t readPlain(std::vector<double>& numbers, size_t most);
  size_t readLines(std::vector<double>& numbers, size_t most);
  void readLine(std::string_view line, bool whole);
  size_t readBinary(std::vector<double>& numbers, size_t most);
  bool refill();
  void newLine();
  [[noreturn]] void malformed(std::string_view word) const;

  int fd_;
  NumberFormat format_;
  int perRecord_;
  LineEnds lineEnds_;
  std::string name_;
  std::vector<char> block_;
  size_t begin_ = 0, end_ = 0;  // the unread part of the block
  bool atEnd_ = false, interrupted_ = false;
  std::vector<int> wakeFds_;
  std::function<void(bool)> waiting_;
  uint64_t records_ = 0;
  // Text: the line of begin_, from 1, and the numbers of an incomplete record.
  uint64_t line_ = 1, lastNumberLine_ = 1;
  std::array<double, kMostNumbers> partial_{};
  int partialCount_ = 0;
  int onLine_ = 0;
  std::optional<FirstLine> firstLine_;
  bool firstIsText_ = false;
};

}  // namespace rsphere
