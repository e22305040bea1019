#pragma once
// Escapes text for formats with special characters: HTML and SVG, data URIs, and command lines.
#include <span>
#include <string>
#include <string_view>

namespace rsphere {

// Text as the content of an element or the value of a quoted attribute, in HTML and in XML. Anything not
// allowed in either (bytes that are not UTF-8, control characters except tab and line feed, U+FFFE and
// U+FFFF) becomes U+FFFD.
std::string escaped(std::string_view text);

// "data:image/png;base64,..." for the bytes of a PNG file.
std::string pngUri(std::string_view bytes);

// A word quoted for a POSIX shell: in single quotes unless all of its characters are ordinary.
std::string shellWord(std::string_view word);

// A command line: words quoted by shellWord(), separated by blanks.
std::string shellLine(std::span<const std::string> words);

}  // namespace rsphere
