#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// For printable(): the limit in bytes for paths of opened files and for excerpts.
inline constexpr size_t kLongestName = 480;

// Converts text from a file or a command line for use in a message: to one line that no terminal interprets
// as a command. UTF-8 text is kept. Bytes of control characters (C0, DEL, C1), of characters that end a line
// or change the direction of writing, and of anything that is not UTF-8 are escaped, as in "\x1b". If the
// result is longer than `longest` bytes, its end is replaced by "...".
std::string printable(std::string_view text, size_t longest = 80);

// printable() for the name of a missing file. A long name is shortened in the middle to 80 bytes, because its
// end contains the name of the file itself.
std::string printableName(std::string_view name);

// printable() for a whole message. Words of more than 500 bytes, such as long paths, are shortened in the
// middle, and messages of more than 4000 bytes are cut. All errors (error.h) and all messages of the programs
// are converted by this function. Converting a message twice does not change it.
std::string messageLine(std::string_view text);

// Whether a character is a printable ASCII character or a blank.
inline bool isPrintable(char c) { return c >= ' ' && c <= '~'; }

// White space in files, in any locale.
inline constexpr std::string_view kBlanks = " \t\n\v\f\r";
constexpr bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// The text without blanks at its ends.
constexpr std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// The parts of a text (views into it) that end at one of these characters, and what follows the last one,
// unless it is empty.
inline std::vector<std::string_view> split(std::string_view text, std::string_view ends) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    parts.push_back(text.substr(0, text.find_first_of(ends)));
    text.remove_prefix(std::min(parts.back().size() + 1, text.size()));
  }
  return parts;
}

}  // namespace rad
