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

// The meaning of line ends in records of text: blanks, as in rtrace, or the ends of records. In the latter
// case each line that is not blank is one record. A line with too many or too few columns is then reported,
// where it would otherwise shift all later numbers.
enum class LineEnds : uint8_t { areBlanks, endRecords };

// Reads records of numbers from a file descriptor: text (numbers between white space, perhaps in quotes) or
// native floats or doubles. The reader never waits for input while a complete record has arrived, nor for
// more than the next record needs: a program that writes one record and waits for its answer gets it.
// Holds one block of input (64 KiB). Not thread-safe.
class RecordReader {
 public:
  static constexpr int kMostNumbers = 6;

  // REQUIRES: format is ascii, float32 or float64; 1 <= numbersPerRecord <= 6. `name` begins the messages.
  // The caller keeps the descriptor open, and closes it.
  RecordReader(int fd, NumberFormat format, int numbersPerRecord, LineEnds lineEnds = LineEnds::areBlanks,
               std::string name = "stdin");

  // The same for the records of a mode. Line ends are the ends of points, because no other program reads
  // points otherwise; between the numbers of rays they are blanks, as in rtrace.
  RecordReader(int fd, const AnswerOptions& options, std::string name = "stdin");

  // Appends the numbers of the next record, for which it waits, and of those after it that have arrived, up
  // to `most` records. Returns the number of records; 0 at the end of input or when interrupted.
  // Throws rad::Error if the next record is malformed or incomplete, after all records before it
  // were returned: 'stdin:3: expected 6 numbers, got "x"'; for binary input with the number of the
  // record, from 1. Malformed are
  // - words that RADIANCE does not read as numbers (nan, inf, 0x10, "1,5", "#") or that a double cannot hold;
  // - where line ends are the ends of records, lines with fewer or more numbers, or longer than 64 KiB;
  // - binary numbers that are not finite.
  // Throws rad::Error with Status::system if read(2) fails.
  size_t read(std::vector<double>& numbers, size_t most);

  // Waits for the next record and returns the number of records that have arrived, at most `most`. The next
  // read() returns them.
  size_t arrived(size_t most);

  // `waiting` is called with true before the reader waits for input, and with false afterwards.
  void whenWaiting(std::function<void(bool)> waiting) { waiting_ = std::move(waiting); }

  // When one of these descriptors becomes readable, waiting ends, and read() returns 0 from then on.
  void interruptBy(std::vector<int> fds) { wakeFds_ = std::move(fds); }
  bool interrupted() const { return interrupted_; }

  // The numbers of records returned and of bytes read from the descriptor so far.
  uint64_t records() const { return records_; }
  uint64_t bytes() const { return bytes_; }

  // The fraction of a regular file that was returned, from 0 to 1; 0 for other input.
  double shareRead() const;

  // The first line of text that is not blank, after it was read to its end: its number of numbers
  // shows whether the records have the expected columns. Empty for binary input, and where line
  // ends are the ends of records.
  struct FirstLine {
    uint64_t line = 1;
    int numbers = 0;
  };
  const std::optional<FirstLine>& firstLine() const { return firstLine_; }

  // Whether the first record of binary input, after it was read, consists of printable characters only. Text
  // does; hardly any floats or doubles do.
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
  size_t begin_ = 0, end_ = 0;  // the part of the block that is still to be read
  bool atEnd_ = false, interrupted_ = false;
  std::vector<int> wakeFds_;
  std::function<void(bool)> waiting_;
  uint64_t records_ = 0, bytes_ = 0;
  // Text: the line that begin_ lies on, from 1, and the numbers of a record that is still incomplete.
  uint64_t line_ = 1, lastNumberLine_ = 1;
  std::array<double, kMostNumbers> partial_{};
  int partialCount_ = 0;
  int onLine_ = 0;
  std::optional<FirstLine> firstLine_;
  bool firstIsText_ = false;
};

}  // namespace rsphere
