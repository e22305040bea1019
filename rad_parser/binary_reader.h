#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/error.h"

namespace rad {

// The format that a line of an information header names ("FORMAT=..."), without blanks around it; empty where
// it names none.
std::optional<std::string_view> headerFormat(std::string_view line);

// Reads the portable binary data of octrees and meshes, from a file descriptor, in blocks: memory does not
// grow with the file. Every function throws fault("truncated KIND") where the data end too early, and Error
// with Status::system where they cannot be read. Source: RADIANCE file formats, "Octree format".
class BinaryReader {
 public:
  static constexpr size_t kLongestString = 1 << 16;  // as the words of scene text
  static constexpr size_t kLongestHeader = 1 << 20;

  // descriptor stays the caller's. name, kind: as messages have them ("scene.oct", "octree"). ahead: what was
  // read from the descriptor already; at most half a block (128 kB).
  BinaryReader(int descriptor, std::string name, std::string kind, std::string_view ahead = {});

  // The information header, up to its empty line. "#?RADIANCE" need not be its first line: octrees of 1989
  // have none.
  struct Header {
    std::vector<std::string> lines;  // but those that name the format, without line ends
    std::string format;              // as the last of these names it; empty where there is none
  };
  // Throws where the data do not begin with a printable character, or end before the header does.
  Header header();

  // "scene.oct: not an octree: its header says FORMAT=..."
  Error otherFormat(std::string_view format) const;

  uint8_t byte() {
    if (next_ == end_) need(1);
    return *next_++;
  }

  // An integer of 1 to 8 bytes, the highest first, in two's complement.
  int64_t integer(int bytes) {
    if (end_ - next_ < bytes) need(static_cast<size_t>(bytes));
    if (bytes == 4) {  // what files have but for museum pieces: told apart so that it is one load
      const uint32_t word = uint32_t{next_[0]} << 24 | next_[1] << 16 | next_[2] << 8 | next_[3];
      next_ += 4;
      return static_cast<int32_t>(word);
    }
    auto value = static_cast<uint64_t>(int64_t{static_cast<int8_t>(*next_++)});
    for (int i = 1; i < bytes; ++i) value = value << 8 | *next_++;
    return static_cast<int64_t>(value);
  }
  uint32_t count16() { return static_cast<uint32_t>(integer(2)) & 0xffff; }

  // A real number: m = 4 bytes, e = 1 byte stand for (m + 1/2) / (2^31 - 1) * 2^e, away from zero for
  // negative m; m = 0 is zero. The writer truncates, so what was written is met within 2^-31 of itself;
  // magnitudes beyond 2^127 and below 2^-129 were lost when written.
  double real() {
    if (end_ - next_ < 5) need(5);
    const auto m = static_cast<int32_t>(integer(4));
    const auto e = static_cast<int8_t>(*next_++);
    if (m == 0) return 0;
    // The product with the reciprocal, not the quotient: the same double, to the last bit, as other readers
    // have.
    return (m + (m < 0 ? -.5 : .5)) * (1. / 0x7fffffff) * kPowers[128 + e];
  }

  // Bytes up to a NUL, without it. Valid until the next call.
  std::string_view string();

  // Bytes read so far.
  uint64_t offset() const { return blockOffset_ + static_cast<uint64_t>(next_ - block_.get()); }

  // How many more bytes there are, where that can be told (a regular file); else 0.
  uint64_t remaining() const;

  const std::string& name() const { return name_; }

  // "scene.oct: TEXT at byte 1234".
  Error fault(std::string_view text) const;

 private:
  // 2^-128 .. 2^127: the exponents that a byte holds.
  static constexpr auto kPowers = [] {
    std::array<double, 256> powers{};
    powers[128] = 1;
    for (int e = 1; e < 128; ++e) powers[128 + e] = powers[127 + e] * 2;
    for (int e = 1; e <= 128; ++e) powers[128 - e] = powers[129 - e] / 2;
    return powers;
  }();

  std::string notThis() const;  // "scene.oct: not an octree"
  void need(size_t bytes);
  bool refill(const uint8_t*& keep);

  int descriptor_;  // -1: nothing more to read
  std::string name_, kind_;
  uint64_t blockOffset_ = 0;  // of the block's first byte in the data
  std::unique_ptr<uint8_t[]> block_;
  const uint8_t* next_;
  const uint8_t* end_;
};

}  // namespace rad
