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

// The format in a line of an information header ("FORMAT=..."), without surrounding blanks. Empty if the line
// contains no format.
std::optional<std::string_view> headerFormat(std::string_view line);

// Reads the portable binary data of octrees and meshes from a file descriptor, in blocks, so that memory does
// not grow with the file. Every function throws fault("truncated KIND") if the data end early, and Error with
// Status::system if they cannot be read. Source: RADIANCE file formats, "Octree format".
class BinaryReader {
 public:
  static constexpr size_t kLongestString = 1 << 16;  // like the words of scene text
  static constexpr size_t kLongestHeader = 1 << 20;

  // The caller closes the descriptor. name, kind: for messages ("scene.oct", "octree"). ahead: data already
  // read from the descriptor, at most half a block (128 kB).
  BinaryReader(int descriptor, std::string name, std::string kind, std::string_view ahead = {});

  // The information header, which ends with an empty line. Its first line need not be "#?RADIANCE", because
  // octrees of 1989 lack that line.
  struct Header {
    std::vector<std::string> lines;  // without line ends and without FORMAT lines
    std::string format;              // the last format that is given; empty if there is none
  };
  // Throws if the data do not begin with a printable character, or if they end within the header.
  Header header();

  // "scene.oct: not an octree: its header says FORMAT=..."
  Error otherFormat(std::string_view format) const;

  uint8_t byte() {
    if (next_ == end_) need(1);
    return *next_++;
  }

  // An integer of 1 to 8 bytes in two's complement, most significant byte first.
  int64_t integer(int bytes) {
    if (end_ - next_ < bytes) need(static_cast<size_t>(bytes));
    if (bytes == 4) {  // used by nearly all files; separate, so that it compiles to a single load
      const uint32_t word = uint32_t{next_[0]} << 24 | next_[1] << 16 | next_[2] << 8 | next_[3];
      next_ += 4;
      return static_cast<int32_t>(word);
    }
    auto value = static_cast<uint64_t>(int64_t{static_cast<int8_t>(*next_++)});
    for (int i = 1; i < bytes; ++i) value = value << 8 | *next_++;
    return static_cast<int64_t>(value);
  }
  uint32_t count16() { return static_cast<uint32_t>(integer(2)) & 0xffff; }

  // A real number. A mantissa m of 4 bytes and an exponent e of 1 byte represent (m+1/2)/(2^31-1) * 2^e, or
  // (m-1/2)/(2^31-1) * 2^e for negative m; m = 0 represents zero. The writer truncates, so the result has a
  // relative error of at most 2^-31. Magnitudes above 2^127 and below 2^-129 are lost in writing.
  double real() {
    if (end_ - next_ < 5) need(5);
    const auto m = static_cast<int32_t>(integer(4));
    const auto e = static_cast<int8_t>(*next_++);
    if (m == 0) return 0;
    // Other readers also multiply by the reciprocal instead of dividing, so that results agree to the last
    // bit.
    return (m + (m < 0 ? -.5 : .5)) * (1. / 0x7fffffff) * kPowers[128 + e];
  }

  // The bytes before the next NUL, which is skipped. Valid until the next call.
  std::string_view string();

  // The number of bytes read.
  uint64_t offset() const { return blockOffset_ + static_cast<uint64_t>(next_ - block_.get()); }

  // The number of bytes left in a regular file; 0 if the data come from anywhere else.
  uint64_t remaining() const;

  const std::string& name() const { return name_; }

  // "scene.oct: TEXT at byte 1234".
  Error fault(std::string_view text) const;

 private:
  // 2^-128 to 2^127, for all exponents of one byte.
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

  int descriptor_;  // -1 at the end of the data
  std::string name_, kind_;
  uint64_t blockOffset_ = 0;  // offset of the block's first byte in the data
  std::unique_ptr<uint8_t[]> block_;
  const uint8_t* next_;
  const uint8_t* end_;
};

}  // namespace rad
