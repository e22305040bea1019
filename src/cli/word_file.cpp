#include "cli/word_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iomanip>

#include "rad_parser/error.h"
#include "rad_parser/file_path.h"

namespace rsphere {
namespace {

constexpr size_t kMostWords = 1000000;

}  // namespace

std::vector<std::string> wordsOfFile(std::string_view what, const std::string& name) {
  const auto path = rad::findFile(name, rad::libraryPath());
  errno = path ? 0 : ENOENT;
  std::ifstream file(path.value_or(name));
  std::vector<std::string> words;
  for (std::string word; path && file >> std::setw(kLongestWord + 1) >> word;) {
    words.push_back(word);
    // Reading an endless device ends at these limits.
    if (words.size() > kMostWords || word.size() > kLongestWord)
      throw rad::Error(
          fmt::format("{} \"{}\" has {}", what, name,
                      word.size() > kLongestWord ? "a word that is too long" : "too many words"));
  }
  if (errno != 0 && (!path || !file.is_open() || file.bad()))
    throw rad::Error(fmt::format("cannot open {} \"{}\": {}", what, name, std::strerror(errno)),
                     rad::Status::system);
  return words;
}

}  // namespace rsphere
