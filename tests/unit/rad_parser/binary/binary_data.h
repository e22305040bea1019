#pragma once
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

// Writes data in the portable binary format of octrees and meshes, value by value.
struct BinaryData {
  std::string bytes;

  BinaryData& integer(int64_t value, int width) {
    for (int i = width - 1; i >= 0; --i) bytes += static_cast<char>(i < 8 ? value >> 8 * i : 0);
    return *this;
  }
  BinaryData& string(std::string_view text) {
    bytes += text;
    bytes += '\0';
    return *this;
  }
  BinaryData& real(int64_t mantissa, int exponent) { return integer(mantissa, 4).integer(exponent, 1); }
};

inline std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
