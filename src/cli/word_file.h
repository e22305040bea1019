#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rad {
class OpenFile;
}

namespace rsphere {

// Words as in scene text, from any list: a file of names or numbers, an option file, a variable. They are
// separated by white space, which quotes include in a word; a byte order mark is skipped. RADIANCE reads the
// modifiers of rcontrib -M in this way, because ies2rad quotes all names that it writes. name: for messages.
// Both throw rad::Error with the place of an unclosed quote, a NUL byte, or a word of more than 65536 bytes,
// and if there are more than `most` words, which ends the reading of an endless device.
std::vector<std::string> wordsOf(const rad::OpenFile& file, const std::string& name, size_t most);
std::vector<std::string> wordsOf(std::string_view text, const std::string& name, size_t most);

// The words of a file named on the command line, at most a million. As in rtrace, the file is searched for
// along RAYPATH. what: for messages ("cannot open modifier file "x": ..."). Throws rad::Error, with
// Status::system if the file cannot be read.
std::vector<std::string> wordsOfFile(std::string_view what, const std::string& name);

}  // namespace rsphere
