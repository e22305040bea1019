#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rsphere {

// Cap on the bytes of a word in a file, as in scene text. It also ends the reading of an endless device.
inline constexpr size_t kLongestWord = 65536;

// The words of a file named on the command line, at most a million. As in rtrace, the file is searched for
// along RAYPATH. what: for messages ("cannot open modifier file "x": ..."). Throws rad::Error, with
// Status::system if the file cannot be read.
std::vector<std::string> wordsOfFile(std::string_view what, const std::string& name);

}  // namespace rsphere
