#pragma once
#include <string>
#include <string_view>

namespace rad {

// The text on one line, for messages: control characters are replaced, and text beyond `longest`
// bytes is replaced by "...".
std::string printable(std::string_view text, size_t longest = 80);

// Whether a character is a printable ASCII character or a blank.
inline bool isPrintable(char c) { return c >= ' ' && c <= '~'; }

}  // namespace rad
