#pragma once
#include <string>
#include <string_view>

namespace rad {

// For printable(): no path of a file that was opened and no excerpt is shown with more bytes.
inline constexpr size_t kLongestName = 480;

// Text from a file or a command line in a form that a message can contain: one line that no terminal takes
// for a command. UTF-8 text remains as it is. Bytes of control characters (C0, DEL, C1), of characters that
// end a line or change the direction of writing, and of anything that is not UTF-8 are written as "\x1b".
// Text that is then longer than `longest` bytes ends with "..." instead of its rest.
std::string printable(std::string_view text, size_t longest = 80);

// The name of a file that is missing, in the same form. A long one is shown with its beginning and its end,
// where the file's own name is, in at most 80 bytes.
std::string printableName(std::string_view name);

// A whole message in the same form. Of a word of more than 500 bytes, as a long path, only the beginning and
// the end are kept, and a message of more than 4000 bytes is cut. Every error (error.h) and
// every message of the programs passes here. The result is the same when it passes twice.
std::string messageLine(std::string_view text);

// Whether a character is a printable ASCII character or a blank.
inline bool isPrintable(char c) { return c >= ' ' && c <= '~'; }

}  // namespace rad
