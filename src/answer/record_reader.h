#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answer/number_format.h"

namespace rsphere {

struct AnswerOptions;

// What line ends mean in records of text: nothing, as in rtrace, or the end of a record. Where they end it, a
// line that is not blank is one record, so that a column too many or too few is found on its own line instead
// of moving all numbers behind it.
enum class LineEnds : uint8_t { areBlanks, endRecords };

// Reads records of numbers from a file descriptor: text (numbers between white space, each read whole and
// perhaps in quotes) or native floats or doubles.
// Never asks for input while a whole record is at hand, and never for more than the next record needs: a
// program that writes one record and waits for its answer gets it.
// Holds one block of input (64 KiB). Not thread-safe: one caller at a time.
class RecordReader {
 public:
  static constexpr int kMostNumbers = 6;

  // REQUIRES: format is ascii, float32 or float64; 1 <= numbersPerRecord <= 6. `name` begins the messages.
  // The descriptor stays the caller's.
  RecordReader(int fd, NumberFormat format, int numbersPerRecord, LineEnds lineEnds = LineEnds::areBlanks,
               std::string name = "stdin");

  // The same for the records that the options name. Line ends end points, because no other program reads
  // points in another way; they are blanks between the numbers of rays, as in rtrace.
  RecordReader(int fd, const AnswerOptions& options, std::string name = "stdin");

  // Appends the numbers of at least one record, waiting for it, and of up to `most` if they are at hand
  // already. Returns how many records; 0 at the end of input, or when interrupted. Throws rad::Error where
  // the next record is malformed or short, once all before it were returned: 'stdin:3: expected 6 numbers,
  // got "x"', or with the number of the record, from 1, for binary input. Text is malformed that RADIANCE
  // does not read as a number (nan, inf, 0x10, "1,5", "#"), and what a double cannot hold; where line ends
  // end records, also a line of fewer or more numbers, or of more than 64 KiB. Binary numbers must be finite.
  // Status::system where read(2) fails.
  size_t read(std::vector<double>& numbers, size_t most);

  // Called with true before the reader waits for input that is not there yet, with false after it.
  void whenWaiting(std::function<void(bool)> waiting) { waiting_ = std::move(waiting); }

  // Descriptors that end the wait as soon as one of them can be read: read() then returns 0 from now on.
  void interruptBy(std::vector<int> fds) { wakeFds_ = std::move(fds); }
  bool interrupted() const { return interrupted_; }

  // Records returned so far, and bytes read from the descriptor.
  uint64_t records() const { return records_; }
  uint64_t bytes() const { return bytes_; }

  // How much of a regular file was returned, from 0 to 1; 0 for other input.
  double shareRead() const;

  // The first line of text that is not blank, once it was read to its end: records in other columns than
  // expected can be told from it. Empty for binary input, and where line ends end records.
  struct FirstLine {
    uint64_t line = 1;
    int numbers = 0;
  };
  const std::optional<FirstLine>& firstLine() const { return firstLine_; }

  // Whether the first record of binary input, once it was read, is printable characters alone: hardly any
  // floats or doubles are, and text is.
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
  size_t begin_ = 0, end_ = 0;  // what of the block is not used yet
  bool atEnd_ = false, interrupted_ = false;
  std::vector<int> wakeFds_;
  std::function<void(bool)> waiting_;
  uint64_t records_ = 0, bytes_ = 0;
  // Text: the line of begin_ from 1, and the numbers of a record that is not whole yet.
  uint64_t line_ = 1, lastNumberLine_ = 1;
  std::array<double, kMostNumbers> partial_{};
  int partialCount_ = 0;
  int onLine_ = 0;
  std::optional<FirstLine> firstLine_;
  bool firstIsText_ = false;
};

}  // namespace rsphere
