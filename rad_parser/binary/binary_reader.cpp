#include "rad_parser/binary/binary_reader.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>

#include "rad_parser/block.h"
#include "rad_parser/printable.h"

namespace rad {
namespace {

constexpr size_t kBlock = 1 << 18;
static_assert(kBlock > 2 * BinaryReader::kLongestString);
constexpr std::string_view kFormatMark = "FORMAT=";

}  // namespace

std::optional<std::string_view> headerFormat(std::string_view line) {
  if (!line.starts_with(kFormatMark)) return std::nullopt;
  line.remove_prefix(kFormatMark.size());
  line = line.substr(0, line.find_first_of("\r\n"));
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return line.substr(0, line.find_last_not_of(" \t") + 1);
}

BinaryReader::BinaryReader(int descriptor, std::string name, std::string kind, std::string_view ahead)
    : descriptor_(descriptor), name_(std::move(name)), kind_(std::move(kind)), block_(new uint8_t[kBlock]) {
  std::copy(ahead.begin(), ahead.end(), block_.get());
  next_ = block_.get();
  end_ = next_ + ahead.size();
}

Error BinaryReader::fault(std::string_view text) const {
  return Error(fmt::format("{}: {} at byte {}", printable(name_, kLongestName), text, offset()));
}

// Moves the data starting at keep to the front of the block, adjusts next_, and appends newly read data. At
// the end of the data, returns false and moves nothing.
bool BinaryReader::refill(const uint8_t*& keep) {
  if (descriptor_ < 0) return false;
  blockOffset_ += static_cast<uint64_t>(keep - block_.get());
  return readOn(descriptor_, block_.get(), kBlock, keep, next_, end_,
                [&] { return printable(name_, kLongestName); });
}

void BinaryReader::need(size_t bytes) {
  const uint8_t* keep = next_;
  while (static_cast<size_t>(end_ - next_) < bytes) {
    if (refill(keep)) continue;
    next_ = end_;
    throw fault("truncated " + kind_);
  }
}

std::string_view BinaryReader::string() {
  const uint8_t* start = next_;
  const uint8_t* seen = next_;
  for (;;) {
    if (const void* nul = seen == end_ ? nullptr : std::memchr(seen, 0, static_cast<size_t>(end_ - seen))) {
      const auto* last = static_cast<const uint8_t*>(nul);
      const auto length = static_cast<size_t>(last - start);
      if (length > kLongestString) break;
      next_ = last + 1;
      return {reinterpret_cast<const char*>(start), length};
    }
    const auto length = static_cast<size_t>(end_ - start);
    if (length > kLongestString) break;
    if (!refill(start)) {
      next_ = end_;
      throw fault("truncated " + kind_);
    }
    seen = start + length;
  }
  throw fault(fmt::format("damaged {}: a string of more than {} bytes", kind_, kLongestString));
}

std::string BinaryReader::notThis() const {
  const bool vowel = std::string_view("aeiou").find(kind_[0]) != std::string_view::npos;
  return fmt::format("{}: not {} {}", printable(name_, kLongestName), vowel ? "an" : "a", kind_);
}

Error BinaryReader::otherFormat(std::string_view format) const {
  return Error(fmt::format("{}: its header says {}{}", notThis(), kFormatMark, printable(format)));
}

BinaryReader::Header BinaryReader::header() {
  Header header;
  std::vector<std::string>& lines = header.lines;
  for (std::string line;; line.clear()) {
    for (;;) {
      if (next_ == end_) {
        const uint8_t* keep = next_;
        if (refill(keep)) continue;
        if (offset() == 0) throw Error(notThis() + ": 0 bytes (did the program that makes it fail?)");
        throw lines.empty() ? Error(notThis()) : fault("truncated " + kind_);
      }
      const char c = static_cast<char>(*next_++);
      if (offset() == 1 && !isPrintable(c)) throw Error(notThis());
      if (c == '\n') break;
      line += c;
      if (offset() > kLongestHeader) throw Error(notThis());
    }
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) return header;
    if (const std::optional<std::string_view> format = headerFormat(line))
      header.format = *format;
    else
      lines.push_back(line);
  }
}

uint64_t BinaryReader::remaining() const {
  struct stat status;
  if (descriptor_ < 0 || fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const auto size = static_cast<uint64_t>(status.st_size);
  return size > offset() ? size - offset() : 0;
}

}  // namespace rad
