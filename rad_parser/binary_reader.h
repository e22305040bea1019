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

// The format that a line of an information header names ("FORMAT=..."), without surrounding blanks.
// Empty if the line names none.
std::optional<std::string_view> headerFormat(std::string_view line);

// Reads the portable binary data of octrees and meshes from a file descriptor, in blocks, so that memory does
// not grow with the file. Every function throws fault("truncated KIND") if the data end too early, and Error
// with Status::system if they cannot be read. Source: RADIANCE file formats, "Octree format".
class BinaryReader {
 public:
  static constexpr size_t kLongestString = 1 << 16;  // as of the words of scene text
  static constexpr size_t kLongestHeader = 1 << 20;

  // The caller closes the descriptor. name, kind: for messages ("scene.oct", "octree"). ahead: data that were
  // read from the descriptor before, at most half a block (128 kB).
  BinaryReader(int descriptor, std::string name, std::string kind, std::string_view ahead = {});

  // The information header, which ends with an empty line. Its first line need not be "#?RADIANCE",
  // which octrees of 1989 lack.
  struct Header {
    std::vector<std::string> lines;  // without line ends; lines that name the format are left out
    std::string format;              // the last one that is named; empty if there is none
  };
  // Throws if the data do not begin with a printable character, or if they end before the header does.
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
    if (bytes == 4) {  // nearly every file; separate, so that it compiles to a single load
      const uint32_t word = uint32_t{next_[0]} << 24 | next_[1] << 16 | next_[2] << 8 | next_[3];
      next_ += 4;
      return static_cast<int32_t>(word);
    }
    auto value = static_cast<uint64_t>(int64_t{static_cast<int8_t>(*next_++)});
    for (int i = 1; i < bytes; ++i) value = value << 8 | *next_++;
    return static_cast<int64_t>(value);
  }
  uint32_t count16() { return static_cast<uint32_t>(integer(2)) & 0xffff; }

  // A real number: a mantissa m of 4 bytes and an exponent e of 1 byte represent (m+1/2)/(2^31-1) * 2^e,
  // or (m-1/2)/(2^31-1) * 2^e for negative m; m = 0 represents zero. The writer truncates, so the
  // relative error against the number that was written is at most 2^-31. Magnitudes above 2^127 and below
  // 2^-129 are lost when written.
  double real() {
    if (end_ - next_ < 5) need(5);
    const auto m = static_cast<int32_t>(integer(4));
    const auto e = static_cast<int8_t>(*next_++);
    if (m == 0) return 0;
    // Multiplying by the reciprocal, instead of dividing, gives the same double as other
    // readers, to the last bit.
    return (m + (m < 0 ? -.5 : .5)) * (1. / 0x7fffffff) * kPowers[128 + e];
  }

  // The bytes up to a NUL, which is skipped. Valid until the next call.
  std::string_view string();

  // The number of bytes read so far.
  uint64_t offset() const { return blockOffset_ + static_cast<uint64_t>(next_ - block_.get()); }

  // The number of bytes that are left, if it is known because the data come from a regular file; otherwise 0.
  uint64_t remaining() const;

  const std::string& name() const { return name_; }

  // "scene.oct: TEXT at byte 1234".
  Error fault(std::string_view text) const;

 private:
  // 2^-128 .. 2^127, for the exponents that a byte can hold.
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
