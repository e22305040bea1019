#pragma once
// The plan as a file: text for SVG, and names of files.
#include <string>
#include <string_view>

namespace rsphere {

// Text as the content of an element or the value of a quoted attribute, in HTML and in XML. Anything not
// allowed in either (bytes that are not UTF-8, control characters except tab and line feed, U+FFFE and
// U+FFFF) becomes U+FFFD.
std::string escaped(std::string_view text);

// Throws the fault of writeTextFile() before the work whose result is to be written, and changes nothing. An
// empty name stands for no file.
void requireWritable(const std::string& name);

// Writes a file. Throws rad::Error (Status::system) with its name and the system's reason if it cannot.
void writeTextFile(const std::string& name, std::string_view text);

// Throws rad::Error if an option gives a file for a diagram a name with the extension of another format than
// SVG, because programs would open it in that format. what: the diagram, such as "the plan".
void requireSvgName(std::string_view option, const std::string& name, std::string_view what);

}  // namespace rsphere
