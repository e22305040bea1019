#include "records/record_reader.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "rad_parser/number.h"
#include "rad_parser/printable.h"

namespace rsphere {
namespace {

// The capacity of a pipe on Linux, which is the most that one read(2) can return from a pipe.
constexpr size_t kBlock = 65536;
// Longer words are rejected. The exact decimal digits of any double are shorter.
constexpr size_t kLongestWord = 4096;
// Messages show at most this many characters of a malformed word.
constexpr size_t kShownWord = 40;

bool isQuote(char c) { return c == '"' || c == '\''; }
bool startsNumber(char c) { return (c >= '0' && c <= '9') || c == '.'; }

bool isText(std::string_view bytes) {
  return std::ranges::all_of(bytes, [](char c) { return rad::isBlank(c) || rad::isPrintable(c); });
}

std::string_view counted(int n) { return n == 1 ? "number" : "numbers"; }

// The number of a word, which may be quoted.
std::optional<double> numberOf(std::string_view word) {
  if (word.size() > kLongestWord) return std::nullopt;
  if (word.size() >= 2 && isQuote(word.front()) && word.back() == word.front())
    return rad::parseReal(word.substr(1, word.size() - 2));
  return rad::parseReal(word);
}

}  // namespace

RecordReader::RecordReader(int fd, NumberFormat format, int numbersPerRecord, LineEnds lineEnds,
                           std::string name)
    : fd_(fd),
      format_(format),
      perRecord_(numbersPerRecord),
      lineEnds_(lineEnds),
      name_(std::move(name)),
      block_(kBlock) {}

size_t RecordReader::read(std::vector<double>& numbers, size_t most) {
  const size_t count = format_ != NumberFormat::ascii      ? readBinary(numbers, most)
                       : lineEnds_ == LineEnds::endRecords ? readLines(numbers, most)
                                                           : readText(numbers, most);
  records_ += count;
  return count;
}

size_t RecordReader::arrived(size_t most) {
  if (begin_ == end_) refill();
  RecordReader ahead = *this;
  ahead.atEnd_ = true;  // does not read from the descriptor
  std::vector<double> numbers;
  try {
    return ahead.read(numbers, most);
  } catch (const rad::Error&) {
    return 0;  // read() will report the error
  }
}

double RecordReader::shareRead() const {
  struct stat status {};
  if (fstat(fd_, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const off_t at = lseek(fd_, 0, SEEK_CUR);
  if (at < 0 || status.st_size <= 0) return 0;
  return static_cast<double>(at - static_cast<off_t>(end_ - begin_)) / static_cast<double>(status.st_size);
}

// Makes room in the block and reads the input that has arrived; waits for the first byte. Returns false at
// the end of input or if interrupted.
bool RecordReader::refill() {
  if (atEnd_ || interrupted_) return false;
  std::memmove(block_.data(), block_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  std::vector<pollfd> ready{{fd_, POLLIN, 0}};
  for (const int wake : wakeFds_) ready.push_back({wake, POLLIN, 0});
  bool told = false;
  for (int patience = 0;; patience = -1) {
    const int n = poll(ready.data(), ready.size(), patience);
    if (n < 0 && errno != EINTR) throw rad::systemError(name_);
    if (n > 0) break;
    if (!told && waiting_) {
      waiting_(true);
      told = true;
    }
  }
  if (told) waiting_(false);
  for (size_t i = 1; i < ready.size(); ++i)
    if (ready[i].revents != 0) interrupted_ = true;
  if (interrupted_) return false;
  ssize_t got;
  do got = ::read(fd_, block_.data() + end_, block_.size() - end_);
  while (got < 0 && (errno == EINTR || errno == EAGAIN));
  if (got < 0) throw rad::systemError(name_);
  atEnd_ = got == 0;
  end_ += static_cast<size_t>(got);
  return !atEnd_;
}

void RecordReader::newLine() {
  if (!firstLine_ && onLine_ > 0) firstLine_ = FirstLine{line_, onLine_};
  onLine_ = 0;
  ++line_;
}

void RecordReader::malformed(std::string_view word) const {
  if (records_ == 0 && rad::isUtf16(word)) throw rad::Error(fmt::format("{}: {}", name_, rad::kUtf16));
  double number = 0;
  const auto [end, error] = rad::readReal(word.data(), word.data() + word.size(), number);
  const bool whole = end == word.data() + word.size();
  const char* hint = "";
  if (whole && error == std::errc::result_out_of_range) hint = ", beyond the range of numbers";
  if (!whole && (*end == ',' || *end == ';')) hint = "; blanks separate numbers, and decimals need a point";
  throw rad::Error(fmt::format("{}:{}: expected {} {}, got \"{}\"{}", name_, line_, perRecord_,
                               counted(perRecord_), rad::printable(word, kShownWord), hint));
}

// A fast path for most text after the first line: reads records in the block up to the first that does not
// consist of plain numbers.
size_t RecordReader::readPlain(std::vector<double>& numbers, size_t most) {
  const char* at = block_.data() + begin_;
  const char* const stop = block_.data() + end_;
  uint64_t line = line_;
  for (size_t count = 0;; ++count) {
    begin_ = static_cast<size_t>(at - block_.data());
    line_ = line;
    if (count == most) return count;
    std::array<double, kMostNumbers> record;
    uint64_t numberLine = line;
    for (int i = 0; i < perRecord_; ++i) {
      for (; at < stop && rad::isBlank(*at); ++at) line += *at == '\n';
      const char* const digits = at + (at < stop && *at == '-');
      if (digits == stop || !startsNumber(*digits)) return count;
      const auto [end, error] = rad::readReal(at, stop, record[i]);
      if (error != std::errc() || end == stop || !rad::isBlank(*end)) return count;
      numberLine = line;
      at = end;
    }
    lastNumberLine_ = numberLine;
    numbers.insert(numbers.end(), record.begin(), record.begin() + perRecord_);
  }
}

size_t RecordReader::readText(std::vector<double>& numbers, size_t most) {
  size_t count = 0;
  while (count < most) {
    if (partialCount_ == 0 && firstLine_) {
      count += readPlain(numbers, most - count);
      if (count == most) break;
    }
    const char* at = block_.data() + begin_;
    const char* const stop = block_.data() + end_;
    for (; at < stop && rad::isBlank(*at); ++at)
      if (*at == '\n') newLine();
    begin_ = static_cast<size_t>(at - block_.data());
    const char* const next = std::find_if(at, stop, rad::isBlank);
    const std::string_view word(at, static_cast<size_t>(next - at));
    if (next == stop && !atEnd_ && word.size() <= kLongestWord) {
      // Return the records that have arrived before waiting for more.
      if (count > 0 || interrupted_) break;
      refill();
      if (interrupted_) break;
      continue;
    }
    if (word.empty()) {
      if (partialCount_ == 0 || count > 0) break;
      throw rad::Error(fmt::format("{}:{}: expected {} {}, got {}", name_, lastNumberLine_, perRecord_,
                                   counted(perRecord_), partialCount_));
    }
    if (count == 0 && records_ == 0 && partialCount_ == 0 && word.starts_with(rad::kByteOrderMark)) {
      begin_ += rad::kByteOrderMark.size();
      continue;
    }
    const std::optional<double> x = numberOf(word);
    if (!x) {
      if (count > 0) break;
      malformed(word);
    }
    begin_ = static_cast<size_t>(next - block_.data());
    partial_[partialCount_++] = *x;
    lastNumberLine_ = line_;
    ++onLine_;
    if (partialCount_ == perRecord_) {
      numbers.insert(numbers.end(), partial_.begin(), partial_.begin() + perRecord_);
      partialCount_ = 0;
      ++count;
    }
  }
  return count;
}

// Reads the numbers of a line into partial_. Throws rad::Error if the line is not a record. whole: whether
// the end of the line has arrived.
void RecordReader::readLine(std::string_view line, bool whole) {
  int count = 0;
  for (size_t at = 0;;) {
    while (at < line.size() && rad::isBlank(line[at])) ++at;
    if (at == line.size()) break;
    const std::string_view word(line.begin() + at, std::find_if(line.begin() + at, line.end(), rad::isBlank));
    const std::optional<double> x = numberOf(word);
    if (!x) malformed(word);
    if (count < perRecord_) partial_[count] = *x;
    ++count;
    at += word.size();
  }
  if (count == perRecord_ && whole) return;
  const std::string got = whole ? std::to_string(count) : fmt::format("more than {} bytes", line.size());
  constexpr int kPoint = 3, kRay = 6;
  const std::string_view hint = count == kRay && whole     ? "; use -S- for rays"
                                : count == kPoint && whole ? "; with -Su they are an eye and its gaze"
                                                           : "";
  throw rad::Error(fmt::format("{}:{}: expected {} {} on a line, got {}{}", name_, line_, perRecord_,
                               counted(perRecord_), got, hint));
}

size_t RecordReader::readLines(std::vector<double>& numbers, size_t most) {
  size_t count = 0;
  while (count < most) {
    const char* at = block_.data() + begin_;
    const char* const stop = block_.data() + end_;
    for (; at < stop && rad::isBlank(*at); ++at) line_ += *at == '\n';
    begin_ = static_cast<size_t>(at - block_.data());
    const char* const lineEnd = std::find(at, stop, '\n');
    const bool whole = lineEnd < stop || atEnd_;
    if (!whole && end_ - begin_ < block_.size()) {
      // Return the records that have arrived before waiting for more.
      if (count > 0 || interrupted_) break;
      refill();
      if (interrupted_) break;
      continue;
    }
    if (at == stop) break;
    if (count == 0 && records_ == 0 &&
        std::string_view(at, static_cast<size_t>(lineEnd - at)).starts_with(rad::kByteOrderMark)) {
      begin_ += rad::kByteOrderMark.size();
      continue;
    }
    try {
      readLine({at, static_cast<size_t>(lineEnd - at)}, whole);
    } catch (const rad::Error&) {
      if (count > 0) break;  // return these records first; the next call will report the error
      throw;
    }
    numbers.insert(numbers.end(), partial_.begin(), partial_.begin() + perRecord_);
    begin_ = static_cast<size_t>(lineEnd - block_.data());
    ++count;
  }
  return count;
}

size_t RecordReader::readBinary(std::vector<double>& numbers, size_t most) {
  const size_t numberSize = format_ == NumberFormat::float32 ? sizeof(float) : sizeof(double);
  const size_t recordSize = numberSize * static_cast<size_t>(perRecord_);
  while (end_ - begin_ < recordSize)
    if (!refill()) break;
  if (interrupted_) return 0;
  if (end_ - begin_ < recordSize) {
    if (begin_ == end_) return 0;
    const bool looksLikeText = records_ == 0 && isText({block_.data() + begin_, end_ - begin_});
    throw rad::Error(fmt::format("{}: record {}: expected {} bytes, got {}{}", name_, records_ + 1,
                                 recordSize, end_ - begin_,
                                 looksLikeText ? ", all of them printable: use -fa to read text" : ""));
  }
  if (records_ == 0) firstIsText_ = isText({block_.data() + begin_, recordSize});
  size_t count = 0;
  for (; count < most && end_ - begin_ >= recordSize; ++count) {
    const size_t before = numbers.size();
    for (int i = 0; i < perRecord_; ++i) {
      const char* from = block_.data() + begin_ + static_cast<size_t>(i) * numberSize;
      double x;
      if (numberSize == sizeof(float)) {
        float single;
        std::memcpy(&single, from, sizeof single);
        x = single;
      } else {
        std::memcpy(&x, from, sizeof x);
      }
      if (!std::isfinite(x)) {
        numbers.resize(before);
        if (count > 0) return count;
        throw rad::Error(fmt::format("{}: record {}: expected {} {}, got {}", name_, records_ + 1, perRecord_,
                                     counted(perRecord_), x));
      }
      numbers.push_back(x);
    }
    begin_ += recordSize;
  }
  return count;
}

}  // namespace rsphere
