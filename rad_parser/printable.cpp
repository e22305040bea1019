#include "rad_parser/printable.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace rad {
namespace {

constexpr size_t kLongestWord = 500, kLongestMessage = 4000, kLongestMissing = 80;
constexpr std::string_view kCut = "...";

// A character of UTF-8: its code and its length in bytes. The length is 0 if the text does not begin with a
// character in its shortest form.
struct Character {
  uint32_t code = 0;
  size_t length = 0;
};

Character characterAt(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1};
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return {};
  uint32_t code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const uint32_t least = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < least || code > 0x10ffff || surrogate ? Character{} : Character{code, length};
}

bool isShown(const Character& c) {
  const auto within = [&](uint32_t first, uint32_t last) { return c.code >= first && c.code <= last; };
  if (c.length == 0 || within(0, 0x1f) || within(0x7f, 0x9f)) return false;
  const bool turnsDirection = within(0x200e, 0x200f) || within(0x202a, 0x202e) || within(0x2066, 0x2069);
  return !turnsDirection && !within(0x2028, 0x2029);
}

// The first character of the text in printable form. length: its length in the text.
std::string_view firstShown(std::string_view text, size_t& length, std::string& escaped) {
  const Character c = characterAt(text);
  length = std::max<size_t>(c.length, 1);
  if (isShown(c)) return text.substr(0, length);
  escaped.clear();
  for (const char byte : text.substr(0, length)) escaped += fmt::format("\\x{:02x}", byte & 0xffu);
  return escaped;
}

// A printable word, without its middle if it has more than `longest` bytes.
std::string shortened(std::string_view word, size_t longest) {
  if (word.size() <= longest) return std::string(word);
  const size_t half = (longest - kCut.size()) / 2;
  const auto continues = [&](size_t at) { return (static_cast<unsigned char>(word[at]) & 0xc0u) == 0x80; };
  size_t head = half, tail = word.size() - half;
  while (continues(head)) --head;
  while (tail < word.size() && continues(tail)) ++tail;
  return fmt::format("{}{}{}", word.substr(0, head), kCut, word.substr(tail));
}

}  // namespace

std::string printable(std::string_view text, size_t longest) {
  std::string line, escaped;
  for (size_t length = 0; !text.empty(); text.remove_prefix(length)) {
    const std::string_view shown = firstShown(text, length, escaped);
    if (line.size() + shown.size() > longest) return line + std::string(kCut);
    line += shown;
  }
  return line;
}

std::string printableName(std::string_view name) {
  return shortened(printable(name, std::numeric_limits<size_t>::max()), kLongestMissing);
}

std::string messageLine(std::string_view text) {
  const std::string line = printable(text, std::numeric_limits<size_t>::max());
  std::string result;
  for (size_t at = 0; at < line.size();) {
    const size_t blank = std::min(line.find(' ', at), line.size());
    const size_t end = std::min(blank + 1, line.size());
    result += shortened(std::string_view(line).substr(at, blank - at), kLongestWord);
    result.append(line, blank, end - blank);
    at = end;
  }
  return result.size() <= kLongestMessage ? result : printable(result, kLongestMessage);
}

}  // namespace rad
